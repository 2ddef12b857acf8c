#include "core/refinement/rolling_shutter.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/trajectory/sensor_velocity.h"

namespace flytri::refinement {
namespace {

/// Shorter readouts are not corrected. At 10 mm/s, points at the image border are then at most
/// 15 µm off.
constexpr double kLongReadout_s = 3e-3;
/// An estimate this many times its uncertainty is sure: the data of a scan are not independent.
constexpr double kSureSigmas = 8.0;

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
  const std::vector<Twist> of_path = trajectory::sensor_velocities(path);
  std::vector<Twist> velocities(views.size(), Twist::Zero());
  for (std::size_t i = 0; i < on_path.size(); ++i) velocities[on_path[i]] = of_path[i];
  return velocities;
}

std::vector<AlignedView> without_rolling_shutter(std::vector<AlignedView> views, double readout_s,
                                                 const trajectory::RowShare& row_share) {
  std::vector<Isometry> poses;
  poses.reserve(views.size());
  for (const AlignedView& view : views) poses.push_back(view.T_world_sensor);
  const std::vector<Twist> velocities = velocities_of(views, poses);
  const trajectory::Shutter shutter{readout_s, row_share};
  for (std::size_t v = 0; v < views.size(); ++v)
    views[v].view = trajectory::without_rolling_shutter(*views[v].view, velocities[v], shutter);
  return views;
}

}  // namespace flytri::refinement
