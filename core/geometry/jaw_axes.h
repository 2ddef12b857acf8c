/// @file  How a scanned jaw lies in the world frame, computed from its shape, and where on it a
/// place
///        is.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "core/geometry/rigid.h"
#include "core/geometry/surfel.h"
#include "core/geometry/triangle_mesh.h"

namespace flytri {

enum class JawKind { kUpper, kLower };

/// Three places on the chewing surfaces of a jaw that set its occlusal plane; world frame, mm.
using OcclusalPoints = std::array<Vec3, 3>;

struct JawAxes {
  Vec3 occlusal = Vec3::UnitZ();  ///< unit, out of the chewing surfaces
  Vec3 buccal = Vec3::UnitY();    ///< unit, perpendicular to it, towards the cheek or the lips
  /// The smallest box that holds the surface, in the frame of R_jaw_world(); empty without one.
  Eigen::AlignedBox3d box_mm;
  bool is_arch = false;  ///< from molars to molars; `buccal` is to the front

  /// Rows: buccal x occlusal, buccal, occlusal. For an arch, the first is the patient's right if
  /// the jaw is a lower one, and the left if it is an upper one.
  [[nodiscard]] Eigen::Matrix3d R_jaw_world() const;
  /// The eight corners of the box in the world frame; none if it is empty.
  [[nodiscard]] std::vector<Vec3> corners_mm() const;
};

/// The occlusal direction is the mean normal, as a jaw is scanned from one side. Perpendicular to
/// it, a quadrant is long and narrow and bends around the tongue: its long axis is the larger
/// principal axis of the positions, and its ends lie on the side of the tongue. If the bend is too
/// slight to decide, the side that most flank normals face is taken as that of the cheek.
[[nodiscard]] JawAxes jaw_axes(const SurfelModel& model);
[[nodiscard]] JawAxes jaw_axes(const TriangleMesh& mesh);

/// The parts of an arch. A quadrant alone does not show which of its ends is the front.
enum class JawPart { kUnknown, kFront, kPremolars, kMolars, kInside };
enum class JawSide { kOcclusal, kBuccal, kLingual };

struct JawPlace {
  JawPart part = JawPart::kUnknown;
  bool is_on_positive_side = false;  ///< of an arch: along the first row of R_jaw_world()
  JawSide side = JawSide::kOcclusal;
};

/// Divides an arch by shares of its depth, so the border between two teeth may be off by one tooth.
/// @param normal  unit, out of the surface
[[nodiscard]] JawPlace place_on_jaw(const JawAxes& axes, const Vec3& position_mm,
                                    const Vec3& normal);

}  // namespace flytri
