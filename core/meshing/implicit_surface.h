/// @file  Implicit surface of oriented points: the zero set of a signed distance function.
#pragma once

#include <optional>
#include <vector>

#include "core/geometry/point_cloud.h"
#include "core/geometry/point_grid.h"

namespace flytri::meshing {

/// Estimate of the surface at one place.
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
  /// @param reach_mm  > 0, radius of the points used
  /// @param gap_mm    >= reach_mm, larger radius, used where fewer than three points are within
  ///                  reach_mm
  ImplicitSurface(const PointCloud& points, float sigma_mm, float reach_mm, float gap_mm);

 private:
  friend class SurfaceProbe;

  const PointCloud& points_;
  float sigma_mm_;
  float reach_mm_;
  float gap_mm_;
  PointGrid grid_;
};

/// Evaluates an implicit surface: fast if each place is near the last one. Not thread-safe.
class SurfaceProbe {
 public:
  /// @param surface  kept by reference
  explicit SurfaceProbe(const ImplicitSurface& surface) : surface_(surface), near_(surface.grid_) {}

  /// The estimate at a place; nullopt if fewer than three points are near. Far from points the
  /// Gaussian is wider, so that both sides of a gap are blended.
  [[nodiscard]] std::optional<SurfaceEstimate> at(const Vec3f& place_mm);

  /// From the surface to a place, along the estimated normal: a part of at().
  [[nodiscard]] std::optional<Vec3f> offset_mm(const Vec3f& place_mm);

  /// SurfaceEstimate::distance_mm alone.
  [[nodiscard]] std::optional<float> distance_mm(const Vec3f& place_mm);

  /// True if a place on the surface has points all around: their centroid is near it, or, in a
  /// wider gap, there are points in all directions and the surface is smooth.
  [[nodiscard]] bool surrounded(const Vec3f& place_mm, const Vec3f& normal);

 private:
  template <typename Visit>
  [[nodiscard]] bool weigh(const Vec3f& place_mm, const Visit& visit);
  [[nodiscard]] bool surrounded_closely(const Vec3f& place_mm, const Vec3f& normal);
  [[nodiscard]] bool in_smooth_gap(const Vec3f& place_mm, const Vec3f& normal);

  const ImplicitSurface& surface_;
  PointWalk near_;
  std::vector<float> angles_;
};

}  // namespace flytri::meshing
