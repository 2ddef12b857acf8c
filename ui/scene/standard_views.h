/// @file  The views that dentists know by name, from the shape of what was scanned.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "core/geometry/rigid.h"
#include "core/geometry/surfel.h"
#include "core/geometry/triangle_mesh.h"

namespace flytri::ui {

enum class StandardView {
  kOcclusal,  ///< onto the chewing surfaces
  kBuccal,    ///< from the cheek's side
  kLingual    ///< from the tongue's side
};

/// How a jaw lies in the world frame.
struct JawAxes {
  Vec3 occlusal = Vec3::UnitZ();  ///< unit, out of the chewing surfaces
  Vec3 buccal = Vec3::UnitY();    ///< unit, perpendicular to it, towards the cheek or the lips
  /// Of the smallest box along the axes that holds the surface; empty where there is none.
  std::vector<Vec3> corners_mm;
};

/// The chewing surfaces, gum and flanks are seen from one side only: that side is the mean normal.
/// Across it a quadrant is long and narrow, and bends around the tongue: its long axis is the
/// larger principal axis of the positions, and the ends lie on the tongue's side of the middle.
/// Where the bend is too slight to tell the sides apart, the side that the larger part of the flank
/// normals faces is taken for the cheek's.
[[nodiscard]] JawAxes jaw_axes(const SurfelModel& model);
[[nodiscard]] JawAxes jaw_axes(const TriangleMesh& mesh);

/// The orientation of the eye for a view.
[[nodiscard]] Eigen::Quaterniond orientation(const JawAxes& axes, StandardView view);

}  // namespace flytri::ui
