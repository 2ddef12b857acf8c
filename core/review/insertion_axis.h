/// @file  A mesh -> the axis of insertion with the least undercut within a cone.
#pragma once

#include "core/base/result.h"
#include "core/base/workers.h"
#include "core/geometry/triangle_mesh.h"

namespace flytri::review {

struct AxisOptions {
  /// Default 0.52 (30 degrees), (0, 1.4]. Half the opening of the cone, rad.
  double cone_rad = 0.52;
  /// Default 0.001, >= 0. Axes whose undercut is larger by less than this share of the surface are
  /// as good; the middle of all of these is chosen.
  double equal_share = 0.001;

  [[nodiscard]] Result<void> validate() const;
};

struct InsertionAxis {
  Vec3 axis = Vec3::UnitZ();      ///< unit, from the tooth to where the restoration comes off
  double undercut_mm2 = 0.0;      ///< each triangle hidden as its middle is
  double equal_within_rad = 0.0;  ///< axes up to this far from it are as good, at least in part
};

/// The mean outward normal of a surface: a first axis for a part that was scanned from its side.
/// Zero for a closed surface.
[[nodiscard]] Vec3 mean_normal(const TriangleMesh& mesh);

/// Tries axes over the whole cone, then twice in finer steps around the best. Surface that leans
/// back by less than a degree counts less, deeper undercut counts more. This decides between axes
/// with the same area.
/// @param start  the axis of the cone, of any length above 0
/// @errors  kBadOption; kInsufficient: no triangles.
[[nodiscard]] Result<InsertionAxis> find_insertion_axis(const TriangleMesh& mesh, const Vec3& start,
                                                        const AxisOptions& options,
                                                        const Workers& workers);

}  // namespace flytri::review
