/// @file  The part of LiveSurface that colors the cells.
#include <algorithm>
#include <cmath>

#include "core/live/live_surface.h"

namespace flytri::live {

std::vector<std::uint32_t> LiveSurface::cells_around(
    const Isometry& T_world_sensor, const calibration::Calibration& calibration) const {
  // No point of the measurement volume is farther from its center.
  const double reach_mm =
      (0.5 + options_.texture.volume_margin_share) * calibration.volume.size_mm.norm();
  const Vec3f middle_mm = T_world_sensor.translation().cast<float>();
  std::vector<std::uint32_t> around;
  for (std::uint32_t i = 0; i < cells_.size(); ++i) {
    if (shown(cells_[i]) && (surfels_[i].position_mm - middle_mm).norm() <= reach_mm) {
      around.push_back(i);
    }
  }
  return around;
}

template <typename Wanted>
Result<std::vector<std::uint32_t>> LiveSurface::observe(const texture::TextureFrame& frame,
                                                        const calibration::Calibration& calibration,
                                                        const Wanted& wanted) {
  // Use all cells: the others may hide the wanted ones.
  std::vector<std::uint32_t> around = cells_around(frame.T_world_sensor, calibration);
  std::vector<SurfacePoint> points;
  std::vector<texture::ObservedColor> colors;
  for (const std::uint32_t i : around) {
    points.push_back({surfels_[i].position_mm, surfels_[i].normal, {}, 0.0F});
    colors.push_back(cells_[i].color);
  }
  if (auto seen =
          texture::observe_points(points, colors, frame, calibration, options_.texture, Workers(1));
      !seen) {
    return tl::unexpected(seen.error());
  }
  for (std::size_t k = 0; k < around.size(); ++k) {
    if (wanted(around[k])) cells_[around[k]].color = colors[k];
  }
  return around;
}

Result<void> LiveSurface::add_color(const texture::TextureFrame& frame,
                                    const calibration::Calibration& calibration) {
  const auto around = observe(frame, calibration, [](std::uint32_t) { return true; });
  if (!around) return tl::unexpected(around.error());
  for (const std::uint32_t cell : *around) refresh_cell(cell);
  return {};
}

Result<void> LiveSurface::recolor(const Isometry& T_world_sensor,
                                  std::span<const texture::TextureFrame> frames,
                                  const calibration::Calibration& calibration) {
  const std::vector<std::uint32_t> forgotten = cells_around(T_world_sensor, calibration);
  for (const std::uint32_t cell : forgotten) cells_[cell].color = {};
  const auto is_forgotten = [&](std::uint32_t cell) {
    return std::binary_search(forgotten.begin(), forgotten.end(), cell);
  };
  const double reach_mm =
      (1.0 + 2.0 * options_.texture.volume_margin_share) * calibration.volume.size_mm.norm();
  for (const texture::TextureFrame& frame : frames) {
    const Vec3 between_mm = frame.T_world_sensor.translation() - T_world_sensor.translation();
    if (between_mm.norm() > reach_mm) continue;
    if (const auto around = observe(frame, calibration, is_forgotten); !around) {
      return tl::unexpected(around.error());
    }
  }
  for (const std::uint32_t cell : forgotten) refresh_cell(cell);
  return {};
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
