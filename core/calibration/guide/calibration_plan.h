/// @file  Plan of a guided calibration: the target placements and the shots of each.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/calibration/record/calibration_set.h"

namespace flytri::calibration {

/// The target in front of the sensor.
enum class TargetFace { kWhitePlane, kDots };

/// Kind of an image. kVerticalAgain does not belong to the set: it shows whether the plane moved
/// during the shots before. kDots is taken by the measurement camera, kDotsTexture by the texture
/// camera, both with the flash. A sensor without a texture camera has no flash: use a lamp.
enum class ShotKind { kDark, kVertical, kHorizontal, kVerticalAgain, kDots, kDotsTexture };

/// The name shown to the user.
[[nodiscard]] std::string_view to_string(TargetFace face);
[[nodiscard]] std::string_view to_string(ShotKind kind);
[[nodiscard]] TargetFace face_of(ShotKind kind);
/// The shots of a target, in the order of taking.
/// @param has_texture  the sensor has a texture camera
[[nodiscard]] const std::vector<ShotKind>& shots_of(TargetFace face, bool has_texture);

/// kByPlane: both targets at one depth, then the next depth. kByTarget: the white plane at all
/// depths, then the dots; the stage must return to the same depths.
enum class PlacementOrder { kByPlane, kByTarget };

/// One placement: the user puts a target at a depth, where it does not move during its shots.
struct Placement {
  std::size_t plane = 0;  ///< index in CalibrationPlan::z_mm
  TargetFace face = TargetFace::kWhitePlane;
  bool operator==(const Placement&) const = default;
};

struct CalibrationPlan {
  MeasurementVolume volume;
  std::array<int, 2> line_counts{};  ///< by Pattern, each at least 1
  DotTarget dots;
  std::vector<double> z_mm;  ///< depths of the planes, rising; z points away from the camera
  PlacementOrder order = PlacementOrder::kByPlane;
  bool has_texture = true;  ///< the sensor has a texture camera
  /// As check_numbers: a check before any image is taken.
  [[nodiscard]] Result<void> validate() const;
};

[[nodiscard]] std::vector<Placement> placements_of(const CalibrationPlan& plan);

/// Depths at equal distances through the volume.
/// @param depth_share  1..1.5, range of the depths divided by the volume's depth; a little above 1
///                     avoids extrapolation at the ends
[[nodiscard]] std::vector<double> even_depths_mm(const MeasurementVolume& volume, int count,
                                                 double depth_share);

}  // namespace flytri::calibration
