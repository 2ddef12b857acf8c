#include "core/texture/color_points.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/geometry/point_grid.h"

namespace flytri::texture {
namespace {

/// Share of the time for the frames; the rest is for points that no frame saw.
constexpr double kFramesShare = 0.9;
constexpr std::size_t kGrain = 1024;

/// The points that were observed.
struct ObservedPoints {
  std::vector<std::uint32_t> points;
  std::vector<Vec3f> positions_mm;
};

/// Gives the observed points their color.
ObservedPoints color_observed(std::span<SurfacePoint> points,
                              std::span<const ObservedColor> colors) {
  ObservedPoints observed;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!colors[i].observed()) continue;
    points[i].color = colors[i].color();
    observed.points.push_back(static_cast<std::uint32_t>(i));
    observed.positions_mm.push_back(points[i].position_mm);
  }
  return observed;
}

/// Colors observed points; the others get the color of their nearest observed neighbor.
Result<ColorCounts> spread_colors(std::span<SurfacePoint> points,
                                  std::span<const ObservedColor> colors, float reach_mm,
                                  const Workers& workers, const Progress& progress) {
  const ObservedPoints observed = color_observed(points, colors);
  ColorCounts counts;
  counts.observed = observed.points.size();
  counts.untextured = points.size() - counts.observed;
  if (counts.observed == 0 || reach_mm <= 0.0F) {
    progress.advance();
    return counts;
  }
  const PointGrid grid(observed.positions_mm, 0.25F * reach_mm);
  std::vector<char> extended(points.size(), 0);
  const auto extend = [&](std::size_t i) {
    if (colors[i].observed()) return;
    const auto nearest = grid.nearest(points[i].position_mm, reach_mm);
    if (!nearest) return;
    points[i].color = points[observed.points[nearest->index]].color;
    extended[i] = 1;
  };
  if (!workers.for_each_unless_cancelled(points.size(), extend, progress, kGrain)) {
    return stopped();
  }
  counts.extended = static_cast<std::size_t>(std::count(extended.begin(), extended.end(), 1));
  counts.untextured -= counts.extended;
  return counts;
}

}  // namespace

Result<ColorCounts> color_points(std::span<SurfacePoint> points,
                                 std::span<const TextureFrame> frames,
                                 const calibration::Calibration& calibration,
                                 const TextureOptions& options, const Workers& workers,
                                 const Progress& progress) {
  if (auto valid = options.validate(); !valid) return tl::unexpected(valid.error());
  std::vector<ObservedColor> colors(points.size());
  for (const TextureFrame& frame : frames) {
    if (progress.cancelled()) return stopped();
    auto seen = observe_points(points, colors, frame, calibration, options, workers);
    if (!seen) return tl::unexpected(seen.error());
    progress.advance(kFramesShare / static_cast<double>(frames.size()));
  }
  return spread_colors(points, colors,
                       static_cast<float>(options.extend_share * calibration.volume.size_mm.x()),
                       workers, progress.part(1.0 - kFramesShare));
}

}  // namespace flytri::texture
