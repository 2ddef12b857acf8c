/// @file  How a hand moves the sensor over a mesh: a pose for every moment.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "core/base/result.h"
#include "core/geometry/rigid.h"
#include "hw/simulated/optics/ray_scene.h"
#include "hw/simulated/optics/sensor_model.h"

namespace flytri::simulated {

/// Where the sensor is at one moment.
struct PathPose {
  double time_s = 0.0;
  Isometry T_model_sensor = Isometry::Identity();
};

/// A movement of the sensor, known at any time.
class SensorPath {
 public:
  /// @param poses  at least one, times rising
  /// @errors  kBadOption.
  [[nodiscard]] static Result<SensorPath> from_poses(std::vector<PathPose> poses);

  /// Between the given poses; before the first and after the last the sensor rests.
  [[nodiscard]] Isometry T_model_sensor(double time_s) const;
  [[nodiscard]] double start_s() const { return poses_.front().time_s; }
  [[nodiscard]] double end_s() const { return poses_.back().time_s; }

 private:
  explicit SensorPath(std::vector<PathPose> poses) : poses_(std::move(poses)) {}
  std::vector<PathPose> poses_;
};

/// kQuadrant: half of a dental arch, straight from above, then tilted outwards and inwards.
/// kArch: the same over the whole arch. kOrbit: once around the mesh, rising and sinking.
enum class PathKind { kQuadrant, kArch, kOrbit };

struct PathOptions {
  PathKind kind = PathKind::kArch;
  double duration_s = 1000.0 / 30.0;  ///< > 0. The paper's 1000 views at 30 a second.
  Vec3 up = Vec3::UnitZ();     ///< arch: from the teeth towards the opposing ones. Orbit: the axis.
  Vec3 front = Vec3::UnitY();  ///< arch: from the throat to the incisors. Not along `up`.
  double tilt_rad = 0.785;     ///< 0..1.2, of an arch's second and third pass: 45 degrees
  double speed_variation = 0.25;  ///< 0..0.9, share by which the hand's speed rises and falls
  double tremor_mm = 0.15;        ///< >= 0, standard deviation of the hand's wander
  double tremor_rad = 0.01;       ///< >= 0, of its turning
  std::uint64_t seed = 1;         ///< each number is another hand
  [[nodiscard]] Result<void> validate() const;
};

/// A path over any mesh: rays find the surface, so that it stays in the measurement volume.
/// @errors  kBadOption; kInsufficient: no surface was found where the path leads.
[[nodiscard]] Result<SensorPath> plan_path(const RayScene& scene, const SensorModel& sensor,
                                           const PathOptions& options);

/// The poses of a truth.json, see docs/formats.md.
/// @errors  As read_truth; kInsufficient: it lists no pose.
[[nodiscard]] Result<SensorPath> read_path(const std::filesystem::path& truth_file);

}  // namespace flytri::simulated
