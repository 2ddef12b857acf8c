#include "core/refinement/rolling_shutter.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "core/trajectory/sensor_velocity.h"

namespace flytri::refinement {
namespace {

/// Shorter readouts are not corrected. At 10 mm/s, points at the image border are then at most
/// 15 µm off.
constexpr double kLongReadout_s = 3e-3;
/// An estimate this many times its uncertainty is sure: the data of a scan are not independent.
constexpr double kSureSigmas = 8.0;
/// Longest time between two views over which the velocity of the sensor is interpolated.
constexpr double kMotionGap_s = 0.15;

}  // namespace

bool Readout::is_long() const {
  return std::abs(readout_s) > std::max(kLongReadout_s, kSureSigmas * uncertainty_s);
}

std::vector<Twist> velocities_of(std::span<const AlignedView> views,
                                 std::span<const Isometry> poses) {
  std::vector<trajectory::TimedPose> path;
  std::vector<std::size_t> on_path;
  for (std::size_t v = 0; v < views.size(); ++v) {
    if (views[v].view->profiles.empty()) continue;
    path.push_back({views[v].view->time_s, poses[v]});
    on_path.push_back(v);
  }
  const std::vector<Twist> of_path = trajectory::sensor_velocities(path, kMotionGap_s);
  std::vector<Twist> velocities(views.size(), Twist::Zero());
  for (std::size_t i = 0; i < on_path.size(); ++i) velocities[on_path[i]] = of_path[i];
  return velocities;
}

std::shared_ptr<const View> without_rolling_shutter(const View& view, const Twist& velocity,
                                                    double readout_s, const RowShare& row_share) {
  auto moved = std::make_shared<View>(view);
  for (Profile& profile : moved->profiles) {
    for (ProfilePoint& point : profile.points) {
      point.position_mm =
          seen_late(velocity, readout_s * row_share(point.position_mm), point.position_mm);
    }
  }
  return moved;
}

std::vector<AlignedView> without_rolling_shutter(std::vector<AlignedView> views, double readout_s,
                                                 const RowShare& row_share) {
  std::vector<Isometry> poses;
  poses.reserve(views.size());
  for (const AlignedView& view : views) poses.push_back(view.T_world_sensor);
  const std::vector<Twist> velocities = velocities_of(views, poses);
  for (std::size_t v = 0; v < views.size(); ++v)
    views[v].view = without_rolling_shutter(*views[v].view, velocities[v], readout_s, row_share);
  return views;
}

}  // namespace flytri::refinement
