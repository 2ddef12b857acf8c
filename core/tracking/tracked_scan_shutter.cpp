/// @file  The part of TrackedScan that corrects views for a rolling shutter.
#include <utility>

#include "core/tracking/tracked_scan.h"
#include "core/trajectory/sensor_velocity.h"

namespace flytri::tracking {
namespace {

/// Poses on each side that tell how the hand moves at a pose.
constexpr std::size_t kMotionPoses = 2;

/// Velocity of the sensor at a pose, which may be on the path already.
Twist velocity_at(const trajectory::Trajectory& path, double time_s,
                  const Isometry& T_world_sensor) {
  std::vector<trajectory::TimedPose> poses = path.before(time_s, kMotionPoses + 1);
  if (!poses.empty() && poses.back().time_s == time_s) poses.pop_back();
  if (poses.size() > kMotionPoses) poses.erase(poses.begin());
  const std::size_t at = poses.size();
  poses.push_back({time_s, T_world_sensor});
  for (const trajectory::TimedPose& after : path.after(time_s, kMotionPoses))
    poses.push_back(after);
  return trajectory::sensor_velocity(poses, at);
}

}  // namespace

std::vector<Isometry> TrackedScan::moved_on(double time_s) const {
  // With the same acceleration, with the same velocity, with the mean velocity.
  struct Motion {
    std::size_t poses;
    int degree;
  };
  std::vector<Isometry> result;
  for (const Motion& by : {Motion{3, 2}, Motion{2, 1}, Motion{6, 1}}) {
    const std::vector<trajectory::TimedPose> poses = trajectory_.before(time_s, by.poses);
    if (!result.empty() && poses.size() < by.poses) break;
    result.push_back(trajectory::PathFit(poses, by.degree).at(time_s));
  }
  return result;
}

void TrackedScan::correct(IncomingView& incoming, const Isometry& T_world_sensor) const {
  if (!options_.shutter.is_rolling()) return;
  if (incoming.measured == nullptr) incoming.measured = incoming.view;
  const Twist velocity = velocity_at(trajectory_, incoming.view->time_s, T_world_sensor);
  incoming.view =
      trajectory::without_rolling_shutter(*incoming.measured, velocity, options_.shutter);
  incoming.prepared = registration::prepare_view(*incoming.view, options_.smoothing);
}

void TrackedScan::correct_again(std::size_t i) {
  TrackedView& view = views_[i];
  // What edits have cut stays as it was cut.
  if (view.placed.profiles.empty() || view.placed_whole) return;
  IncomingView again{view.aligned.view, {}, view.measured};
  correct(again, view.aligned.T_world_sensor);
  view.aligned.view = std::move(again.view);
  view.measured = std::move(again.measured);
  view.placed = again.prepared.moved(view.aligned.T_world_sensor);
  locate_extent(i);
}

void TrackedScan::correct_all() {
  if (!options_.shutter.is_rolling()) return;
  for (std::size_t i = 0; i < views_.size(); ++i) correct_again(i);
}

}  // namespace flytri::tracking
