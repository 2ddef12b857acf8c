/// @file  The part of LiveSurface that colors the cells.
#include <algorithm>
#include <cmath>

#include "core/live/live_surface.h"

namespace flytri::live {

namespace {

/// The sphere around the measurement volume of a sensor.
struct VolumeSphere {
  Vec3f middle_mm;
  double reach_mm;
  VolumeSphere(const Isometry& T_world_sensor, const calibration::Calibration& calibration,
               const texture::TextureOptions& options)
      : middle_mm(T_world_sensor.translation().cast<float>()),
        reach_mm((0.5 + options.volume_margin_share) * calibration.volume.size_mm.norm()) {}
  [[nodiscard]] bool contains(const Vec3f& p_mm, float radius_mm = 0.0F) const {
    return (p_mm - middle_mm).norm() <= reach_mm + static_cast<double>(radius_mm);
  }
};

}  // namespace

template <typename MayHave, typename Use>
void LiveSurface::for_each_shown(const MayHave& may_have, const Use& use) const {
  // From the middle of a block to its corners, and a little more for rounding.
  const auto radius_mm = static_cast<float>(0.9 * options_.block_cells * cell_mm_);
  for (const Block& block : blocks_) {
    if (!may_have(block.center_mm, radius_mm)) continue;
    for (const std::uint32_t cell : block.cells) {
      if (shown(cells_[cell])) use(cell);
    }
  }
}

std::vector<std::uint32_t> LiveSurface::cells_around(
    const Isometry& T_world_sensor, const calibration::Calibration& calibration) const {
  const VolumeSphere sphere(T_world_sensor, calibration, options_.texture);
  std::vector<std::uint32_t> around;
  for_each_shown([&](const Vec3f& middle_mm,
                     float radius_mm) { return sphere.contains(middle_mm, radius_mm); },
                 [&](std::uint32_t cell) {
                   if (sphere.contains(surfels_[cell].position_mm)) around.push_back(cell);
                 });
  std::sort(around.begin(), around.end());
  return around;
}

template <typename ColorOf>
Result<void> LiveSurface::observe(const texture::TextureFrame& frame,
                                  const calibration::Calibration& calibration,
                                  const ColorOf& color_of) const {
  if (auto fits = texture::check_texture_image(frame.image, calibration); !fits) return fits;
  texture::FrameObserver observer(frame, calibration, options_.texture);
  // All cells that the frame may see: the others may hide the wanted ones.
  std::vector<SurfacePoint> points;
  std::vector<std::pair<std::size_t, texture::ObservedColor*>> wanted;  // number of the point
  for_each_shown([&](const Vec3f& middle_mm,
                     float radius_mm) { return observer.may_see(middle_mm, radius_mm); },
                 [&](std::uint32_t cell) {
                   const Surfel& surfel = surfels_[cell];
                   if (!observer.may_see(surfel.position_mm, 0.0F)) return;
                   if (auto* color = color_of(cell)) wanted.emplace_back(points.size(), color);
                   points.push_back({surfel.position_mm, surfel.normal, {}, 0.0F});
                 });
  if (wanted.empty()) return {};
  const Workers alone(1);
  observer.find_depths(points, texture::block_spheres(points, alone), alone);
  for (const auto& [point, color] : wanted) {
    if (const auto seen = observer.observe(points[point])) color->add(*seen);
  }
  return {};
}

Result<void> LiveSurface::add_color(const texture::TextureFrame& frame,
                                    const calibration::Calibration& calibration) {
  const auto color_of = [this](std::uint32_t cell) { return &cells_[cell].color; };
  if (auto seen = observe(frame, calibration, color_of); !seen) return seen;
  for (const std::uint32_t cell : cells_around(frame.T_world_sensor, calibration))
    refresh_cell(cell);
  return {};
}

LiveSurface::Recoloring LiveSurface::begin_recoloring(
    const Isometry& T_world_sensor, const calibration::Calibration& calibration) const {
  Recoloring recoloring{
      T_world_sensor.translation(), cells_around(T_world_sensor, calibration), {}};
  recoloring.colors.resize(recoloring.cells.size());
  return recoloring;
}

Result<void> LiveSurface::add_color(const texture::TextureFrame& frame,
                                    const calibration::Calibration& calibration,
                                    Recoloring& recoloring) const {
  const VolumeSphere seen(frame.T_world_sensor, calibration, options_.texture);
  // The sphere around the place is as large.
  if (!seen.contains(recoloring.middle_mm.cast<float>(), static_cast<float>(seen.reach_mm)))
    return {};
  const std::vector<std::uint32_t>& cells = recoloring.cells;
  return observe(frame, calibration, [&](std::uint32_t cell) -> texture::ObservedColor* {
    const auto found = std::lower_bound(cells.begin(), cells.end(), cell);
    if (found == cells.end() || *found != cell) return nullptr;
    return &recoloring.colors[static_cast<std::size_t>(found - cells.begin())];
  });
}

void LiveSurface::end_recoloring(const Recoloring& recoloring) {
  for (std::size_t k = 0; k < recoloring.cells.size(); ++k) {
    cells_[recoloring.cells[k]].color = recoloring.colors[k];
    refresh_cell(recoloring.cells[k]);
  }
}

double LiveSurface::texture_pixels(const Isometry& T_world_sensor,
                                   const calibration::Calibration& calibration) const {
  const Isometry T_sensor_world = T_world_sensor.inverse();
  double pixels = 0.0;
  for (const std::uint32_t i : cells_around(T_world_sensor, calibration)) {
    const SurfacePoint point{surfels_[i].position_mm, surfels_[i].normal, {}, 0.0F};
    pixels += area_per_cell_mm2(point.normal) *
              texture::pixels_per_mm2(point, T_sensor_world, calibration, options_.texture);
  }
  return pixels;
}

}  // namespace flytri::live
