/// @file  The path of the sensor over a mesh: its pose at any time.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "core/base/result.h"
#include "core/geometry/rigid.h"
#include "hw/simulated/optics/ray_scene.h"
#include "hw/simulated/optics/sensor_model.h"

namespace flytri::simulated {

/// Sensor pose at one time.
struct PathPose {
  double time_s = 0.0;
  Isometry T_model_sensor = Isometry::Identity();
};

/// A movement of the sensor, interpolated between given poses.
class SensorPath {
 public:
  /// @param poses  at least one, with increasing times
  /// @errors  kBadOption.
  [[nodiscard]] static Result<SensorPath> from_poses(std::vector<PathPose> poses);

  /// Interpolates between the given poses; before the first and after the last, the sensor rests.
  [[nodiscard]] Isometry T_model_sensor(double time_s) const;
  [[nodiscard]] double start_s() const { return poses_.front().time_s; }
  [[nodiscard]] double end_s() const { return poses_.back().time_s; }

 private:
  explicit SensorPath(std::vector<PathPose> poses) : poses_(std::move(poses)) {}
  std::vector<PathPose> poses_;
};

/// kQuadrant: half of a dental arch, first from above, then tilted outwards and inwards. kArch: the
/// same over the whole arch. kOrbit: one turn around the mesh with up and down movement. kFront:
/// from side to side in front of the mesh, from below to above.
enum class PathKind { kQuadrant, kArch, kOrbit, kFront };

struct PathOptions {
  PathKind kind = PathKind::kArch;
  double duration_s = 1000.0 / 30.0;  ///< > 0; default: the paper's 1000 views at 30 Hz
  Vec3 up = Vec3::UnitZ();            ///< arch: towards the opposing teeth; else the axis
  Vec3 front = Vec3::UnitY();         ///< to the incisors, or in which a face looks; not along `up`
  double tilt_rad = 0.785;        ///< 0..1.2, tilt in an arch's second and third pass; default 45°
  double speed_variation = 0.25;  ///< 0..0.9, relative variation of the hand's speed
  double tremor_mm = 0.15;        ///< >= 0, standard deviation of the hand's random translation
  double tremor_rad = 0.01;       ///< >= 0, standard deviation of its random rotation
  std::uint64_t seed = 1;         ///< random seed of the hand's movement
  [[nodiscard]] Result<void> validate() const;
};

/// Plans a path over any mesh. Uses rays to find the surface and keeps it in the measurement
/// volume.
/// @errors  kBadOption; kInsufficient: no surface was found along the path.
[[nodiscard]] Result<SensorPath> plan_path(const RayScene& scene, const SensorModel& sensor,
                                           const PathOptions& options);

/// The poses of a truth.json, see docs/formats.md.
/// @errors  As read_truth; kInsufficient: it contains no pose.
[[nodiscard]] Result<SensorPath> read_path(const std::filesystem::path& truth_file);

}  // namespace flytri::simulated
