#include "hw/design/design_change.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "core/base/check_options.h"
#include "hw/simulated/optics/lens_formula.h"

namespace flytri::design {
namespace {

using simulated::SensorLayout;

constexpr double kMmOfMicrons = 1e-3;
constexpr double kMaxLines = 100;

void change_field(SensorLayout& layout, const Vec2& field_mm) {
  const double factor = (field_mm.array() / layout.volume_mm.head<2>().array()).maxCoeff();
  layout.volume_mm.head<2>() = field_mm;
  layout.focal_px /= factor;
  layout.texture_focal_px /= factor;
  layout.line_width_mm *= factor;
  layout.dots.pitch_mm *= factor;
  layout.dots.diameter_mm *= factor;
  layout.dots.marker_diameter_mm *= factor;
}

Result<void> check_layout(const SensorLayout& layout) {
  const double nearest_mm = layout.distance_mm - 0.5 * layout.volume_mm.z();
  return OptionCheck("SensorLayout")
      .must("depth_mm", layout.volume_mm.z(), nearest_mm > 0.1 * layout.distance_mm,
            "so small that the volume lies before the camera")
      .must("baseline_mm", layout.baseline_mm, layout.baseline_mm < layout.distance_mm,
            "less than the distance: at larger angles only one of both sees the bottom of a gap")
      .result();
}

}  // namespace

Result<void> DesignChange::validate() const {
  OptionCheck check("DesignChange");
  const auto positive = [&](std::string_view name, const std::optional<double>& value) {
    if (value) check.positive(name, *value);
  };
  check.positive("pixel_um", pixel_um);
  if (field_mm) check.positive("field_mm", field_mm->minCoeff());
  positive("depth_mm", depth_mm);
  positive("distance_mm", distance_mm);
  positive("baseline_mm", baseline_mm);
  positive("focus_mm", focus_mm);
  positive("focal_mm", focal_mm);
  positive("camera_aperture_mm", camera_aperture_mm);
  positive("projector_aperture_mm", projector_aperture_mm);
  positive("line_width_mm", line_width_mm);
  if (lines) {
    for (const int count : *lines) check.in_range("lines", count, 1, kMaxLines);
  }
  return check.result();
}

Result<SensorLayout> changed(const SensorLayout& layout, const DesignChange& change) {
  if (auto valid = change.validate(); !valid) return tl::unexpected(valid.error());
  SensorLayout result = layout;
  if (change.field_mm) change_field(result, *change.field_mm);
  if (change.depth_mm) result.volume_mm.z() = *change.depth_mm;
  if (change.distance_mm) {
    result.focus_mm *= *change.distance_mm / result.distance_mm;
    result.distance_mm = *change.distance_mm;
  }
  result.baseline_mm = change.baseline_mm.value_or(result.baseline_mm);
  result.focus_mm = change.focus_mm.value_or(result.focus_mm);
  if (change.camera_aperture_mm) result.camera_aperture_mm = 0.5 * *change.camera_aperture_mm;
  if (change.projector_aperture_mm)
    result.projector_aperture_mm = 0.5 * *change.projector_aperture_mm;
  result.line_width_mm = change.line_width_mm.value_or(result.line_width_mm);
  result.line_counts = change.lines.value_or(result.line_counts);
  if (change.focal_mm) {
    auto fits = OptionCheck("DesignChange")
                    .must("focal_mm", *change.focal_mm, *change.focal_mm < result.focus_mm,
                          "less than the distance of the plane in focus")
                    .result();
    if (!fits) return tl::unexpected(fits.error());
    result.focal_px = simulated::image_distance_mm(*change.focal_mm, result.focus_mm) /
                      (kMmOfMicrons * change.pixel_um);
  }
  if (auto fits = check_layout(result); !fits) return tl::unexpected(fits.error());
  return result;
}

double triangulation_angle_rad(const SensorLayout& layout) {
  return std::atan2(layout.baseline_mm, layout.distance_mm);
}

double camera_focal_mm(const SensorLayout& layout, double pixel_um) {
  return simulated::focal_length_mm(kMmOfMicrons * pixel_um * layout.focal_px, layout.focus_mm);
}

}  // namespace flytri::design
