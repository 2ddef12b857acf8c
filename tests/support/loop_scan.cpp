#include "tests/support/loop_scan.h"

#include <algorithm>
#include <cmath>

#include "tests/support/wavy_scene.h"

namespace flytri::testing {

Result<measurement::MeasuredView> LoopScene::measure(const Frame& frame) const {
  measurement::MeasuredView measured;
  if (is_away(frame.time_s)) {
    measured.outcome = measurement::MeasureOutcome::kTooFewPoints;
    return measured;
  }
  Random random(17, static_cast<std::uint64_t>(frame.index.value));
  measured.view = measure_scene(cusped_height, SceneSensor(), *pattern_of(frame.kind),
                                shifted(loop_pose(frame.time_s), frame.time_s), random);
  measured.view.frame = frame.index;
  measured.view.time_s = frame.time_s;
  return measured;
}

Isometry LoopScene::shifted(const Isometry& T_scene_sensor, double time_s) const {
  constexpr double kSpeed_mm_s = 10.0;
  if (time_s < away_to_s) return T_scene_sensor;
  const double beside_mm = comes_back_beside_mm - kSpeed_mm_s * (time_s - away_to_s);
  return Eigen::Translation3d(std::max(0.0, beside_mm), 0.0, 0.0) * T_scene_sensor;
}

scan::LiveScanOptions options_for(const LoopScene& scene) {
  return steered_options([scene](const Frame& frame) { return scene.measure(frame); });
}

double pose_rms_mm(const std::vector<AlignedView>& views) {
  const Isometry T_scene_world =
      loop_pose(views.front().view->time_s) * views.front().T_world_sensor.inverse();
  double sum = 0.0;
  for (const AlignedView& view : views) {
    const double off_mm = trajectory::pose_distance_mm(T_scene_world * view.T_world_sensor,
                                                       loop_pose(view.view->time_s), 7.0);
    sum += off_mm * off_mm;
  }
  return std::sqrt(sum / static_cast<double>(views.size()));
}

bool ScanNotes::has_each_placed_view_once() const {
  std::map<int, int> counts;
  for (const auto& view : views) ++counts[view->frame.value];
  return std::all_of(poses.begin(), poses.end(), [&](const auto& pose) {
    return counts.count(pose.first) == 1 && counts.at(pose.first) == 1;
  });
}

std::vector<AlignedView> ScanNotes::placed_views() const {
  std::vector<AlignedView> placed;
  for (const auto& view : views) placed.push_back({view, poses.at(view->frame.value)});
  return placed;
}

}  // namespace flytri::testing
