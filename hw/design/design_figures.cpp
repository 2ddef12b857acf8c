#include "hw/design/design_figures.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace flytri::design {
namespace {

using simulated::SensorLayout;
using simulated::SensorModel;

constexpr double kThreePoint_px = 1.0 / 7.0;
// A Gaussian with the width of the Airy disk: sigma = 0.42 wavelength / aperture, as an angle.
constexpr double kDiffraction = 0.42;

double speckle_limit_mm(const SensorModel& sensor, double z_mm) {
  const Vec3 place(0.0, 0.0, z_mm);
  const Vec3 to_camera = sensor.camera.center() - place;
  const Vec3 to_projector = sensor.projector(Pattern::kVertical).center() - place;
  const double sin_theta =
      to_camera.cross(to_projector).norm() / (to_camera.norm() * to_projector.norm());
  const double radius_mm = sensor.camera.lens.aperture_radius_mm;
  const double sin_u = radius_mm / std::hypot(radius_mm, to_camera.norm());
  return sensor.chip.speckle_contrast / (2.0 * std::numbers::pi) * kWavelength_mm /
         (sin_u * sin_theta);
}

DepthFigures depth_figures(const SensorModel& sensor, const LineImager& imager, double z_mm) {
  DepthFigures figures;
  figures.line = imager.figures(z_mm);
  figures.three_point_mm = kThreePoint_px / figures.line.motion_px_per_mm;
  figures.speckle_limit_mm = speckle_limit_mm(sensor, z_mm);
  figures.grooves_along_lines_mm = 2.0 * figures.line.width_mm;
  figures.grooves_across_lines_mm =
      2.0 * std::max(figures.line.camera_blur_px, 1.0) * figures.line.pixel_mm;
  return figures;
}

FocusRange focus_range(const SensorModel& sensor, const LineImager& imager) {
  constexpr int kSteps = 160;
  const double reach_mm = imager_reach_mm(sensor);
  const auto depth = [&](int i) { return (2.0 * i / kSteps - 1.0) * reach_mm; };
  std::array<double, kSteps + 1> widths;
  for (int i = 0; i <= kSteps; ++i) widths[static_cast<std::size_t>(i)] = imager.width_px(depth(i));
  const auto narrowest = std::min_element(widths.begin(), widths.end());
  const double limit = std::numbers::sqrt2 * *narrowest;
  auto first = narrowest;
  while (first != widths.begin() && *(first - 1) <= limit) --first;
  auto last = narrowest;
  while (last + 1 != widths.end() && *(last + 1) <= limit) ++last;
  return {depth(static_cast<int>(first - widths.begin())),
          depth(static_cast<int>(last - widths.begin())), *narrowest};
}

// By a grid over the cross-section.
double seen_share(const SensorModel& sensor) {
  constexpr int kSteps = 40;
  int seen = 0;
  for (int i = 0; i < kSteps; ++i)
    for (int j = 0; j < kSteps; ++j) {
      const Vec3 share((i + 0.5) / kSteps - 0.5, (j + 0.5) / kSteps - 0.5, -0.5);
      const auto pixel = sensor.camera.project(sensor.volume.size_mm.cwiseProduct(share));
      if (pixel && sensor.camera.sees(*pixel)) ++seen;
    }
  return static_cast<double>(seen) / (kSteps * kSteps);
}

PatternFigures pattern_figures(const SensorLayout& layout, const SensorModel& sensor,
                               Pattern pattern) {
  PatternFigures figures;
  figures.lines = sensor.projector(pattern).line_count();
  figures.areas = unique_areas(sensor, pattern, sensor.volume.size_mm.z());
  figures.largest_depth_mm = largest_depth_mm(sensor, pattern);
  figures.most_lines = most_lines(layout, pattern);
  return figures;
}

}  // namespace

Result<DesignFigures> design_figures(const SensorLayout& layout) {
  const SensorModel sensor = make_sensor(layout);
  if (auto valid = sensor.validate(); !valid) return tl::unexpected(valid.error());
  const LineImager imager(sensor, Pattern::kVertical);
  DesignFigures figures;
  for (const int i : {0, 1, 2})
    figures.depths[static_cast<std::size_t>(i)] =
        depth_figures(sensor, imager, 0.5 * (i - 1) * sensor.volume.size_mm.z());
  figures.focus = focus_range(sensor, imager);
  for (const Pattern pattern : kPatterns)
    figures.patterns[static_cast<std::size_t>(pattern)] = pattern_figures(layout, sensor, pattern);
  figures.seen_share = seen_share(sensor);
  figures.diffraction_px = kDiffraction * kWavelength_mm /
                           (2.0 * sensor.camera.lens.aperture_radius_mm) * sensor.camera.focal_px;
  return figures;
}

}  // namespace flytri::design
