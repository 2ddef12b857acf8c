/// @file  What a guided calibration is to take: which target goes where, and which shots of it.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/calibration/record/calibration_set.h"

namespace flytri::calibration {

/// What stands in front of the sensor.
enum class TargetFace { kWhitePlane, kDots };

/// One image. kVerticalAgain is no part of the set: it shows whether the plane rested while the
/// shots before it were taken. kDots is of the measurement camera, kDotsTexture of the texture
/// camera, both in the flash.
enum class ShotKind { kDark, kVertical, kHorizontal, kVerticalAgain, kDots, kDotsTexture };

/// What a user calls it.
[[nodiscard]] std::string_view to_string(TargetFace face);
[[nodiscard]] std::string_view to_string(ShotKind kind);
[[nodiscard]] TargetFace face_of(ShotKind kind);
/// In the order in which they are taken.
[[nodiscard]] const std::vector<ShotKind>& shots_of(TargetFace face);

/// kByPlane: both targets at one depth, then the next depth. kByTarget: the white plane through all
/// depths, then the dots; the stage must find back to the same depths.
enum class PlacementOrder { kByPlane, kByTarget };

/// One handling: a target is put at a depth, and rests there for its shots.
struct Placement {
  std::size_t plane = 0;  ///< index in CalibrationPlan::z_mm
  TargetFace face = TargetFace::kWhitePlane;
  bool operator==(const Placement&) const = default;
};

struct CalibrationPlan {
  MeasurementVolume volume;
  std::array<int, 2> line_counts{};  ///< by Pattern, each at least 1
  DotTarget dots;
  std::vector<double> z_mm;  ///< depths of the planes, rising: away from the camera
  PlacementOrder order = PlacementOrder::kByPlane;
  /// As check_set, before any image is taken.
  [[nodiscard]] Result<void> validate() const;
};

[[nodiscard]] std::vector<Placement> placements_of(const CalibrationPlan& plan);

/// Depths at equal distances through the volume.
/// @param depth_share  1..1.5, what they span by the volume's depth: a little more, so that fits do
///                     not end where they are used
[[nodiscard]] std::vector<double> even_depths_mm(const MeasurementVolume& volume, int count,
                                                 double depth_share);

}  // namespace flytri::calibration
