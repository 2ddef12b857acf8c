/// @file  The surface that oriented points describe, as the zero of a function of space.
#pragma once

#include <optional>
#include <vector>

#include "core/geometry/point_cloud.h"
#include "core/geometry/point_grid.h"

namespace flytri {

/// What the points say at one place.
struct SurfaceEstimate {
  float distance_mm = 0.0F;  ///< signed, positive outside
  SurfacePoint mean;         ///< weighted mean of the points; `position_mm` is their centroid
};

/// Weighted mean of the tangent planes of the points around a place.
/// @source  Kolluri, "Provably good moving least squares", SODA 2005.
class ImplicitSurface {
 public:
  /// @param points    kept by reference
  /// @param sigma_mm  > 0, standard deviation of the Gaussian weight
  /// @param reach_mm  > 0, points farther away count for nothing
  ImplicitSurface(const PointCloud& points, float sigma_mm, float reach_mm);

  /// The estimate at a place, or none where fewer than three points are within reach.
  [[nodiscard]] std::optional<SurfaceEstimate> at(const Vec3f& place_mm) const;

  /// True if points lie all around a place on the surface: their centroid is near it.
  [[nodiscard]] bool surrounded(const Vec3f& place_mm, const Vec3f& normal) const;

 private:
  const PointCloud& points_;
  float sigma_mm_;
  float reach_mm_;
  PointGrid grid_;
};

}  // namespace flytri
