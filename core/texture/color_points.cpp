#include "core/texture/color_points.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/geometry/point_grid.h"
#include "core/texture/merge_observations.h"

namespace flytri::texture {
namespace {

/// Shares of the time for the z-buffers and the colors; the rest is for points that no frame saw.
constexpr double kDepthsShare = 0.3, kColorsShare = 0.6;
constexpr std::size_t kGrain = 1024;

/// The points that were observed, and where they are.
struct ObservedPoints {
  std::vector<std::uint32_t> points;
  std::vector<Vec3f> positions_mm;
};

ObservedPoints list_observed(std::span<const SurfacePoint> points, std::span<const char> observed) {
  ObservedPoints list;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (observed[i] == 0) continue;
    list.points.push_back(static_cast<std::uint32_t>(i));
    list.positions_mm.push_back(points[i].position_mm);
  }
  return list;
}

/// Colors the points of a block that at least one frame observes, and marks them.
void color_block(std::span<SurfacePoint> block, const BoundingSphere& sphere,
                 std::span<char> observed, std::span<const FrameObserver> observers) {
  std::vector<const FrameObserver*> near;
  for (const FrameObserver& observer : observers) {
    if (observer.may_see(sphere.middle_mm, sphere.radius_mm)) near.push_back(&observer);
  }
  std::vector<Observation> seen;
  for (std::size_t i = 0; i < block.size(); ++i) {
    seen.clear();
    for (const FrameObserver* observer : near) {
      if (const auto observation = observer->observe(block[i])) seen.push_back(*observation);
    }
    if (seen.empty()) continue;
    block[i].color = to_color(merge_observations(seen));
    observed[i] = 1;
  }
}

/// Gives the points that were not observed the color of their nearest observed neighbor.
Result<ColorCounts> spread_colors(std::span<SurfacePoint> points, std::span<const char> is_observed,
                                  float reach_mm, const Workers& workers,
                                  const Progress& progress) {
  const ObservedPoints observed = list_observed(points, is_observed);
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
    if (is_observed[i] != 0) return;
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
  const std::vector<BoundingSphere> spheres = block_spheres(points, workers);
  std::vector<FrameObserver> observers;
  observers.reserve(frames.size());
  for (const TextureFrame& frame : frames) {
    if (progress.cancelled()) return stopped();
    if (auto fits = check_texture_image(frame.image, calibration); !fits) {
      return tl::unexpected(fits.error());
    }
    observers.emplace_back(frame, calibration, options);
    observers.back().find_depths(points, spheres, workers);
    progress.advance(kDepthsShare / static_cast<double>(frames.size()));
  }
  if (frames.empty()) progress.advance(kDepthsShare);
  std::vector<char> observed(points.size(), 0);
  const auto color = [&](std::size_t b) {
    const std::size_t first = b * kPointBlock, count = std::min(kPointBlock, points.size() - first);
    color_block(points.subspan(first, count), spheres[b], std::span(observed).subspan(first, count),
                observers);
  };
  if (!workers.for_each_unless_cancelled(spheres.size(), color, progress.part(kColorsShare))) {
    return stopped();
  }
  return spread_colors(points, observed,
                       static_cast<float>(options.extend_share * calibration.volume.size_mm.x()),
                       workers, progress.part(1.0 - kDepthsShare - kColorsShare));
}

}  // namespace flytri::texture
