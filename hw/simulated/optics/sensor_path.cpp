#include "hw/simulated/optics/sensor_path.h"

#include <algorithm>
#include <utility>

#include "core/io/recordings/truth.h"

namespace flytri::simulated {

Result<SensorPath> SensorPath::from_poses(std::vector<PathPose> poses) {
  if (poses.empty()) return fail(ErrorCode::kBadOption, "a path needs at least one pose");
  for (std::size_t i = 1; i < poses.size(); ++i)
    if (!(poses[i].time_s > poses[i - 1].time_s))
      return fail(
          ErrorCode::kBadOption,
          "pose {} of the path: its time {} s is not later than the time of the pose before", i,
          poses[i].time_s);
  return SensorPath(std::move(poses));
}

Isometry SensorPath::T_model_sensor(double time_s) const {
  const auto later =
      std::lower_bound(poses_.begin(), poses_.end(), time_s,
                       [](const PathPose& pose, double time) { return pose.time_s < time; });
  if (later == poses_.begin()) return poses_.front().T_model_sensor;
  if (later == poses_.end()) return poses_.back().T_model_sensor;
  const PathPose& a = *(later - 1);
  const PathPose& b = *later;
  const double share = (time_s - a.time_s) / (b.time_s - a.time_s);
  return interpolate(a.T_model_sensor, b.T_model_sensor, share);
}

Result<SensorPath> read_path(const std::filesystem::path& truth_file) {
  const Result<io::Truth> truth = io::read_truth(truth_file);
  if (!truth) return tl::unexpected(truth.error());
  if (truth->poses.empty())
    return fail(ErrorCode::kInsufficient, "{}: the file contains no pose", truth_file.string());
  std::vector<PathPose> poses;
  for (const io::TruthPose& pose : truth->poses)
    poses.push_back({pose.time_s, pose.T_model_sensor});
  auto path = SensorPath::from_poses(std::move(poses));
  if (!path)
    return fail(ErrorCode::kBadFormat, "{}: {}", truth_file.string(), path.error().message);
  return path;
}

}  // namespace flytri::simulated
