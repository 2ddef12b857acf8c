/// @file  A model, and what is asked of it -> the numbers and lines that the command line and the
///        window show.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/base/workers.h"
#include "core/review/insertion_axis.h"
#include "core/review/measure.h"
#include "core/review/section.h"
#include "core/review/undercut.h"

namespace flytri::review {

/// A model as the functions of this folder need it: welded, an oriented manifold, with unit
/// normals.
[[nodiscard]] TriangleMesh made_ready(const TriangleMesh& model);

/// If no vertex has an uncertainty, makes that of all unknown. @return  whether they have one
bool mark_unknown_uncertainty(TriangleMesh& mesh);

/// A distance (mm) or an angle (rad) between points of the surface.
struct ReviewedNumber {
  std::vector<MeasuredPoint> points;
  Measured measured;
};

/// @param distance  of the same mesh
/// @param points_mm  two for a distance; three for an angle, the apex second
[[nodiscard]] ReviewedNumber reviewed_number(const TriangleMesh& mesh, const MeshDistance& distance,
                                             std::span<const Vec3> points_mm);

struct ReviewedSection {
  Plane plane;
  Section outlines;
  std::vector<SectionPlace> places;  ///< none, or two
  std::optional<Measured> along_mm;  ///< between them; none: on different outlines
};

/// @param points_mm  none, or two points near the section
/// @errors  As section_of.
[[nodiscard]] Result<ReviewedSection> reviewed_section(const TriangleMesh& mesh, const Plane& plane,
                                                       std::span<const Vec3> points_mm);

struct UndercutRequest {
  std::optional<Vec3> axis;       ///< none: the one with the least undercut
  std::optional<Vec3> around_mm;  ///< none: the whole model
  double radius_mm = 7.0;         ///< of the part around that place
};

struct ReviewedUndercut {
  TriangleMesh part;
  Vec3 axis = Vec3::UnitZ();           ///< unit
  std::optional<InsertionAxis> found;  ///< if the axis was found by itself
  Undercut undercut;
};

/// @errors  As part_around, find_insertion_axis, find_undercut.
[[nodiscard]] Result<ReviewedUndercut> reviewed_undercut(const TriangleMesh& mesh,
                                                         const UndercutRequest& request,
                                                         const Workers& workers);

/// How deep each vertex of the part is undercut, mm: the deepest of its triangles that are hidden
/// by half or more. 0: free.
[[nodiscard]] std::vector<float> vertex_depths_mm(const ReviewedUndercut& reviewed);

}  // namespace flytri::review
