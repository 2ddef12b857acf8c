/// @file  A mesh and an axis of insertion -> what of the surface is undercut: hidden from a viewer
///          far along the axis, so that nothing stiff that touches it comes off along the axis.
#pragma once

#include <vector>

#include "core/base/result.h"
#include "core/base/workers.h"
#include "core/review/measure.h"

namespace flytri::review {

/// The triangles whose middle is within a radius. Only these hide each other.
/// @errors  kBadOption: the radius; kInsufficient: there are none.
[[nodiscard]] Result<TriangleMesh> part_around(const TriangleMesh& mesh, const Vec3& center_mm,
                                               double radius_mm);

struct UndercutOptions {
  /// Default 0.03, > 0. A triangle is divided until its parts are no wider than this, mm; each part
  /// is hidden or not.
  double part_mm = 0.03;
  /// Default 0.02, > 0. Depths are found on a grid of this step, mm.
  double depth_step_mm = 0.02;
  /// Default 2, > 0. Deeper places get this depth, mm.
  double max_depth_mm = 2.0;
  /// Default 10, >= 2. The uncertainty comes from so many copies of the mesh with other noise.
  int noise_copies = 10;

  [[nodiscard]] Result<void> validate() const;
};

/// The undercut of a mesh for one axis.
struct Undercut {
  /// Of hidden surface, mm^2.
  ///
  /// Surface that faces away from the viewer is hidden, too: the tooth is before it, even if that
  /// side was not scanned. The uncertainty is the RMS change by noise of the vertices, each moved
  /// along its normal by its sigma times a normal random number. So a wall that is nearly along the
  /// axis makes it large.
  /// @source  parametric bootstrap: Efron and Tibshirani, "An Introduction to the Bootstrap", 1993,
  ///          section 6.5.
  Measured area_mm2;
  double surface_mm2 = 0.0;         ///< of the whole mesh
  std::vector<float> hidden_share;  ///< by triangle, 0..1
  /// By triangle, in its middle: how far across the axis the free way out is. 0: not hidden. A
  /// dentist measures this by the gauge of a surveyor.
  std::vector<float> depth_mm;
  double deepest_mm = 0.0;

  /// Hidden surface of triangles that are at least this deep in their middle, mm^2.
  [[nodiscard]] double area_deeper_mm2(const TriangleMesh& mesh, double least_mm) const;
};

/// @param mesh  indices valid
/// @param axis  from the tooth to where the restoration comes off; any length above 0
/// @errors  kBadOption; kInsufficient: no triangles.
[[nodiscard]] Result<Undercut> find_undercut(const TriangleMesh& mesh, const Vec3& axis,
                                             const UndercutOptions& options,
                                             const Workers& workers);

}  // namespace flytri::review
