#include "tests/support/stress_scan.h"

#include <algorithm>
#include <cmath>

#include "core/geometry/decompositions.h"

namespace flytri::testing {
namespace {

constexpr double kArm_mm = 7.0;

/// Number of frames for the whole arch at speed 1.
constexpr double kArchFrames = 1000.0;

Isometry pose_at(const simulated::SensorPath& path, const StressCase& by, int frame,
                 double period_s) {
  const bool jumped = frame >= by.jump_frame;
  const int place = jumped ? frame + by.jump_by : frame;
  Isometry T_model_sensor = path.T_model_sensor(path.start_s() + place * period_s);
  if (jumped) T_model_sensor = T_model_sensor * exp_twist(by.jump_off);
  if (by.away.holds(frame)) {
    T_model_sensor = T_model_sensor * Eigen::Translation3d(0.0, 0.0, -by.lift_mm);
  }
  return T_model_sensor;
}

/// Moves whole profiles far along z and across the line, like a wrong line index.
void mislabel(View& view, double share, Random& random) {
  for (Profile& profile : view.profiles) {
    if (random.uniform() >= share) continue;
    const Vec3 off(random.uniform(-3.0, 3.0), random.uniform(-3.0, 3.0), random.uniform(-6.0, 6.0));
    for (ProfilePoint& point : profile.points) point.position_mm += off;
  }
}

/// Adds four points that represent the pose of a view.
void add_marks(const Isometry& T, std::vector<Vec3>& marks) {
  marks.emplace_back(T.translation());
  for (int axis = 0; axis < 3; ++axis) marks.emplace_back(T * (kArm_mm * Vec3::Unit(axis)));
}

struct PosePair {
  Isometry T_world_sensor, T_model_sensor;

  /// RMS distance, as computed by pose_distance_mm.
  [[nodiscard]] double error_mm(const Isometry& T_model_world) const {
    return trajectory::pose_distance_mm(T_model_sensor, T_model_world * T_world_sensor, kArm_mm);
  }
};

/// Aligns the pairs within `limit_mm` with the truth.
Isometry fit(const std::vector<PosePair>& pairs, const Isometry& T_model_world, double limit_mm) {
  std::vector<Vec3> world, model;
  for (const PosePair& pair : pairs) {
    if (pair.error_mm(T_model_world) > limit_mm) continue;
    add_marks(pair.T_world_sensor, world);
    add_marks(pair.T_model_sensor, model);
  }
  return world.empty() ? T_model_world : best_motion(world, model);
}

std::size_t count_within(const std::vector<PosePair>& pairs, const Isometry& T_model_world,
                         double limit_mm) {
  return static_cast<std::size_t>(std::count_if(
      pairs.begin(), pairs.end(),
      [&](const PosePair& pair) { return pair.error_mm(T_model_world) <= limit_mm; }));
}

/// The alignment that most views agree with, fitted to these views.
Isometry consensus(const std::vector<PosePair>& pairs, double tolerance_mm) {
  Isometry best = Isometry::Identity();
  std::size_t most = 0;
  const std::size_t stride = std::max<std::size_t>(1, pairs.size() / 20);
  for (std::size_t i = 0; i < pairs.size(); i += stride) {
    Isometry T = pairs[i].T_model_sensor * pairs[i].T_world_sensor.inverse();
    for (const double limit_mm : {1.0, 0.5, tolerance_mm}) T = fit(pairs, T, limit_mm);
    const std::size_t count = count_within(pairs, T, tolerance_mm);
    if (count <= most) continue;
    most = count;
    best = T;
  }
  return best;
}

}  // namespace

StressScan take_stress_scan(const simulated::ViewSimulator& simulator, const StressCase& by) {
  const double period_s = simulator.sensor().frame_period_s;
  simulated::PathOptions path_options = by.path;
  path_options.duration_s = kArchFrames / by.speed * period_s;
  const simulated::SensorPath path =
      simulated::plan_path(simulator.scene(), simulator.sensor(), path_options).value();
  StressScan scan;
  for (int frame = 0; frame < by.frame_count; ++frame) {
    const Pattern pattern = frame % 2 == 0 ? Pattern::kVertical : Pattern::kHorizontal;
    Random random(by.noise.seed, static_cast<std::uint64_t>(frame));
    if (by.one_pattern.holds(frame) && pattern != Pattern::kVertical) continue;
    if (random.uniform() < by.missing_share) continue;
    const Isometry T_model_sensor = pose_at(path, by, frame, period_s);
    View view = simulator.trace(pattern, T_model_sensor);
    view = simulated::add_noise(view, by.noise, static_cast<std::uint64_t>(frame));
    mislabel(view, by.outlier_share, random);
    view.frame = FrameIndex(frame);
    view.time_s = frame * period_s;
    scan.views.push_back(std::make_shared<const View>(std::move(view)));
    scan.T_model_sensor.push_back(T_model_sensor);
  }
  return scan;
}

StressVerdict judge_scan(const std::vector<tracking::RegisteredView>& views,
                         const StressScan& truth, double tolerance_mm) {
  std::vector<PosePair> pairs;
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (views[i].fate == tracking::ViewFate::kRejected) continue;
    pairs.push_back({views[i].T_world_sensor, truth.T_model_sensor[i]});
  }
  const Isometry T_model_world = consensus(pairs, tolerance_mm);
  StressVerdict verdict;
  verdict.rejected = static_cast<int>(views.size() - pairs.size());
  for (const PosePair& pair : pairs) {
    const double error_mm = pair.error_mm(T_model_world);
    if (error_mm > tolerance_mm) {
      ++verdict.wrong;
    } else {
      ++verdict.right;
      verdict.worst_right_mm = std::max(verdict.worst_right_mm, error_mm);
    }
  }
  return verdict;
}

}  // namespace flytri::testing
