/// @file  Surface normals at the points of aligned views, computed from crossing profiles.
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
  /// >= 0. Standard deviation of the Gaussian that smooths a profile before its direction is
  /// computed, mm. 0: 4 times the spacing of neighboring points, about the width of a line.
  double tangent_sigma_mm = 0.0;
  /// >= 0. Edge of the cells in which profiles count as crossing, mm. 0: 10 times the spacing of
  /// neighboring points, so that in a finished scan nearly every cell has lines of both patterns.
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
/// direction most perpendicular to all their o; for two profiles this is the cross product. Then
/// the normal of a point is made perpendicular to the o of its own profile, which is the most
/// accurate direction. Where no profiles cross, the normal is extended from the nearest crossings;
/// far from any crossing it is n_in, because a single profile gives no more.
/// @source  Arold et al., "Calculation of Normals": the normal is the cross product of the tangents
///          of two crossing profiles.
/// @param progress  advanced by one step
/// @errors  kBadOption, kCancelled.
[[nodiscard]] Result<std::vector<ViewNormals>> crossing_normals(std::span<const AlignedView> views,
                                                                const NormalOptions& options,
                                                                const Workers& workers,
                                                                const Progress& progress = {});

/// All points with their normals, in the world frame, view after view.
/// @param normals  of the same views
[[nodiscard]] std::vector<SurfaceSample> surface_samples(std::span<const AlignedView> views,
                                                         std::span<const ViewNormals> normals,
                                                         const Workers& workers);

}  // namespace flytri::normals
