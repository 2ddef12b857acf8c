#include "core/texture/color_points.h"

#include <vector>

#include "core/geometry/point_grid.h"

namespace flytri {
namespace {

/// Gives observed points their color, and the others that of their nearest observed neighbor.
ColorCounts spread_colors(std::span<SurfacePoint> points, std::span<const ObservedColor> colors,
                          float reach_mm) {
  ColorCounts counts;
  std::vector<Vec3f> observed_mm;
  std::vector<std::size_t> observed;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!colors[i].observed()) continue;
    points[i].color = colors[i].color();
    observed_mm.push_back(points[i].position_mm);
    observed.push_back(i);
  }
  counts.observed = observed.size();
  if (observed.empty() || reach_mm <= 0.0F) {
    counts.untextured = points.size() - observed.size();
    return counts;
  }
  const PointGrid grid(observed_mm, 0.25F * reach_mm);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (colors[i].observed()) continue;
    const auto nearest = grid.nearest(points[i].position_mm, reach_mm);
    if (nearest) points[i].color = points[observed[nearest->index]].color;
    ++(nearest ? counts.extended : counts.untextured);
  }
  return counts;
}

}  // namespace

Result<ColorCounts> color_points(std::span<SurfacePoint> points,
                                 std::span<const TextureFrame> frames,
                                 const Calibration& calibration, const TextureOptions& options,
                                 const Workers& workers) {
  if (auto valid = options.validate(); !valid) return tl::unexpected(valid.error());
  std::vector<ObservedColor> colors(points.size());
  for (const TextureFrame& frame : frames) {
    auto seen = observe_points(points, colors, frame, calibration, options, workers);
    if (!seen) return tl::unexpected(seen.error());
  }
  return spread_colors(points, colors,
                       static_cast<float>(options.extend_share * calibration.volume.size_mm.x()));
}

}  // namespace flytri
