#include "tests/support/scan_scene.h"

#include <cmath>

namespace flytri::testing {

TrueScan scan_cusps(int view_count, const SceneSensor& sensor, std::uint64_t seed) {
  TrueScan scan;
  Random random(seed);
  Isometry T_model_first = Isometry::Identity();
  for (int i = 0; i < view_count; ++i) {
    const double phase = 0.15 * i;
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
  double sum = 0.0;
  double count = 0.0;
  for (std::size_t i = 0; i < views.size(); ++i) {
    for (const Profile& profile : views[i].view->profiles) {
      for (const ProfilePoint& point : profile.points) {
        sum += (views[i].T_world_sensor * point.position_mm -
                truth[i].T_world_sensor * point.position_mm)
                   .squaredNorm();
        count += 1.0;
      }
    }
  }
  return std::sqrt(sum / count);
}

}  // namespace flytri::testing
