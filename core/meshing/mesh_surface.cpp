#include "core/meshing/mesh_surface.h"

#include <algorithm>

#include "core/base/check_options.h"
#include "core/base/median.h"
#include "core/geometry/point_grid.h"
#include "core/meshing/close_holes.h"
#include "core/meshing/implicit_surface.h"
#include "core/meshing/mesh_topology.h"
#include "core/meshing/surface_nets.h"
#include "core/meshing/trim_rims.h"

namespace flytri::meshing {
namespace {

constexpr double kSpacingOfPoints = 1.2;
constexpr std::size_t kMinPoints = 10;
/// Number of points used to measure the typical spacing.
constexpr std::size_t kSpacingSamples = 2000;
/// Share of the total time for the extraction; the rest is for the topology.
constexpr double kExtractionShare = 0.9;

/// Median distance of a point to its nearest neighbor.
double point_spacing_mm(const PointCloud& points) {
  std::vector<Vec3f> positions;
  Vec3f low = points.front().position_mm;
  Vec3f high = low;
  for (const SurfacePoint& point : points) {
    positions.push_back(point.position_mm);
    low = low.cwiseMin(point.position_mm);
    high = high.cwiseMax(point.position_mm);
  }
  const float extent_mm = std::max((high - low).norm(), 1e-6F);
  // Cell size as if the points filled a square with this diagonal: the right order of magnitude.
  const PointGrid grid(positions, extent_mm / std::sqrt(static_cast<float>(points.size())));
  std::vector<float> distances2;
  std::vector<Neighbor> found;
  const std::size_t step = std::max<std::size_t>(1, points.size() / kSpacingSamples);
  for (std::size_t i = 0; i < points.size(); i += step) {
    grid.nearest(positions[i], 2, extent_mm, found);
    if (found.size() == 2) distances2.push_back(found[1].distance2_mm2);
  }
  if (distances2.empty()) return 0.0;
  return std::sqrt(median_of(distances2));
}

}  // namespace

Result<void> MeshOptions::validate() const {
  return OptionCheck("MeshOptions")
      .not_negative("spacing_mm", spacing_mm)
      .positive("smoothing_spacings", smoothing_spacings)
      .positive("support_spacings", support_spacings)
      .must("gap_spacings", gap_spacings, gap_spacings >= support_spacings,
            "at least support_spacings")
      .not_negative("min_island_spacings2", min_island_spacings2)
      .not_negative("min_strip_spacings", min_strip_spacings)
      .not_negative("close_holes_mm", close_holes_mm)
      .result();
}

Result<SurfaceMesh> mesh_surface(const PointCloud& points, const MeshOptions& options,
                                 const Workers& workers, const Progress& progress) {
  if (auto valid = options.validate(); !valid) return tl::unexpected(valid.error());
  const auto too_few = [&] {
    return fail(ErrorCode::kInsufficient,
                "{} points are too few for a surface; scan more of the object", points.size());
  };
  if (points.size() < kMinPoints) return too_few();
  const double spacing_mm =
      options.spacing_mm > 0.0 ? options.spacing_mm : kSpacingOfPoints * point_spacing_mm(points);
  if (!(spacing_mm > 0.0)) return too_few();
  const ImplicitSurface surface(points, static_cast<float>(options.smoothing_spacings * spacing_mm),
                                static_cast<float>(options.support_spacings * spacing_mm),
                                static_cast<float>(options.gap_spacings * spacing_mm));
  auto mesh = extract_surface(surface, points, static_cast<float>(spacing_mm), workers,
                              progress.part(kExtractionShare));
  if (!mesh) return tl::unexpected(mesh.error());
  const Progress topology = progress.part((1.0 - kExtractionShare) / 3.0);
  SurfaceMesh result;
  result.mesh = std::move(*mesh);
  result.spacing_mm = spacing_mm;
  repair_manifold(result.mesh);
  topology.advance();
  if (progress.cancelled()) return stopped();
  if (options.min_strip_spacings > 0.0) {
    trim_rims(result.mesh, static_cast<float>(options.min_strip_spacings * spacing_mm),
              static_cast<float>(spacing_mm), workers);
  }
  drop_islands(result.mesh, options.min_island_spacings2 * spacing_mm * spacing_mm);
  if (result.mesh.triangles.empty()) return too_few();
  result.closed_holes = close_holes(result.mesh, options.close_holes_mm);
  topology.advance();
  if (progress.cancelled()) return stopped();
  result.boundaries = find_boundaries(result.mesh);
  topology.advance();
  return result;
}

}  // namespace flytri::meshing
