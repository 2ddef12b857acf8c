#include "tests/support/scan_scene.h"

#include <cmath>

#include "core/geometry/decompositions.h"

namespace flytri::testing {

TrueScan scan_cusps(int view_count, const SceneSensor& sensor, std::uint64_t seed, double speed) {
  TrueScan scan;
  Random random(seed);
  Isometry T_model_first = Isometry::Identity();
  for (int i = 0; i < view_count; ++i) {
    const double phase = 0.15 * speed * i;
    Twist twist;
    twist << 0.10 * std::sin(0.7 * phase), 0.12 * std::sin(phase), 0.3 * std::sin(0.4 * phase),
        8.0 * std::sin(0.5 * phase), 5.0 * std::sin(0.8 * phase), 0.5 * std::sin(phase);
    const Isometry T_model_sensor = exp_twist(twist);
    if (i == 0) T_model_first = T_model_sensor;
    const Pattern pattern = i % 2 == 0 ? Pattern::kVertical : Pattern::kHorizontal;
    View view = measure_scene(cusped_height, sensor, pattern, T_model_sensor, random);
    view.frame = FrameIndex(i);
    view.time_s = i / 30.0;
    scan.views.push_back(
        {std::make_shared<View>(std::move(view)), T_model_first.inverse() * T_model_sensor});
  }
  return scan;
}

std::vector<AlignedView> with_drift(const std::vector<AlignedView>& truth, double end_mm,
                                    std::uint64_t seed) {
  Random random(seed);
  const double step_mm = end_mm / std::sqrt(static_cast<double>(truth.size()));
  constexpr double kArmMm = 10.0;
  std::vector<AlignedView> views = truth;
  Isometry drift = Isometry::Identity();
  for (std::size_t i = 1; i < views.size(); ++i) {
    Twist twist;
    for (int axis = 0; axis < 3; ++axis) {
      twist[axis] = step_mm / kArmMm * random.normal();
      twist[axis + 3] = step_mm * random.normal();
    }
    drift = drift * exp_twist(twist);
    views[i].T_world_sensor = truth[i].T_world_sensor * drift;
  }
  return views;
}

double displacement_rms_mm(const std::vector<AlignedView>& views,
                           const std::vector<AlignedView>& truth) {
  const std::vector<Vec3> points_mm = placed_points_mm(views), true_mm = placed_points_mm(truth);
  const Isometry T_truth_world = best_motion(points_mm, true_mm);
  double sum = 0.0;
  for (std::size_t i = 0; i < points_mm.size(); ++i)
    sum += (T_truth_world * points_mm[i] - true_mm[i]).squaredNorm();
  return std::sqrt(sum / static_cast<double>(points_mm.size()));
}

std::vector<Vec3> placed_points_mm(const std::vector<AlignedView>& views) {
  std::vector<Vec3> points_mm;
  for (const AlignedView& view : views) {
    for (const Profile& profile : view.view->profiles) {
      for (const ProfilePoint& point : profile.points)
        points_mm.emplace_back(view.T_world_sensor * point.position_mm);
    }
  }
  return points_mm;
}

}  // namespace flytri::testing
