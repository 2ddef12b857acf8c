/// @file  From aligned views to surface normals at their points, by the profiles that cross there.
#pragma once

#include <span>
#include <vector>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/base/workers.h"
#include "core/geometry/point_cloud.h"
#include "core/geometry/view.h"

namespace flytri::normals {

struct NormalOptions {
  /// >= 0. Reach along a profile from which its direction is taken: standard deviation of a
  /// Gaussian, mm. 0: 4 times the spacing of neighboring points, about the width of a line.
  double tangent_sigma_mm = 0.0;
  /// >= 0. Edge of the cells in which profiles count as crossing, mm. 0: 10 times the spacing of
  /// neighboring points, so that a finished scan has lines of both patterns in nearly each.
  double cell_mm = 0.0;
  /// (0, 1). Sine of the angle between two profiles below which they do not determine a normal.
  double min_crossing_sine = 0.2;

  [[nodiscard]] Result<void> validate() const;
};

/// Normals of one view: by profile, by point, world frame, unit, towards the sensor.
using ViewNormals = std::vector<std::vector<Vec3f>>;

/// Normals of all views.
///
/// In the paper two crossing profiles give n = o^k x o^l, and o is interpolated between crossings
/// along the profile. In a finished scan every place is crossed by many profiles: there n is the
/// direction that is least along all their o, which for two is the cross product. The normal of a
/// point is then made perpendicular to the o of its own profile, which is known best. Where no
/// profile crosses, the normal is carried over from the nearest crossings; far from any it is n_in,
/// which is all that one profile can say.
/// @source  Arold et al., "Calculation of Normals", eq. (full_normal).
/// @param progress  advanced by one step
/// @errors  kBadOption, kCancelled.
[[nodiscard]] Result<std::vector<ViewNormals>> crossing_normals(std::span<const AlignedView> views,
                                                                const NormalOptions& options,
                                                                const Workers& workers,
                                                                const Progress& progress = {});

/// All points with their normals, in the world frame, view after view.
/// @param normals  of the same views
[[nodiscard]] std::vector<SurfaceSample> surface_samples(std::span<const AlignedView> views,
                                                         std::span<const ViewNormals> normals);

}  // namespace flytri::normals
