/// @file  Standard dental views, computed from the shape of the scanned surface.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "core/geometry/rigid.h"
#include "core/geometry/surfel.h"
#include "core/geometry/triangle_mesh.h"

namespace flytri::ui {

enum class StandardView {
  kOcclusal,  ///< onto the chewing surfaces
  kBuccal,    ///< from the side of the cheek
  kLingual    ///< from the side of the tongue
};

/// How a jaw lies in the world frame.
struct JawAxes {
  Vec3 occlusal = Vec3::UnitZ();  ///< unit, out of the chewing surfaces
  Vec3 buccal = Vec3::UnitY();    ///< unit, perpendicular to it, towards the cheek or the lips
  /// Of the smallest box along the axes that holds the surface; empty where there is none.
  std::vector<Vec3> corners_mm;
};

/// The occlusal direction is the mean normal, as a jaw is scanned from one side. Perpendicular to
/// it, a quadrant is long and narrow and bends around the tongue: its long axis is the larger
/// principal axis of the positions, and its ends lie on the side of the tongue. If the bend is too
/// slight to decide, the side that most flank normals face is taken as that of the cheek.
[[nodiscard]] JawAxes jaw_axes(const SurfelModel& model);
[[nodiscard]] JawAxes jaw_axes(const TriangleMesh& mesh);

/// The orientation of the eye for a view.
[[nodiscard]] Eigen::Quaterniond orientation(const JawAxes& axes, StandardView view);

}  // namespace flytri::ui
