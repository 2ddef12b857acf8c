#include "hw/design/design_sweep.h"

#include <algorithm>
#include <cmath>

#include "hw/design/design_change.h"

namespace flytri::design {
namespace {

using simulated::SensorLayout;

constexpr std::array kFactors = {0.5, 0.7, 1.0, 1.4, 2.0};

int scaled_count(int count, double factor) {
  return std::max(static_cast<int>(std::lround(count * factor)), 1);
}

double value_of(const SensorLayout& layout, Knob knob, double pixel_um) {
  switch (knob) {
    case Knob::kBaseline:
      return layout.baseline_mm;
    case Knob::kFocalLength:
      return camera_focal_mm(layout, pixel_um);
    case Knob::kLines:
      return layout.line_counts[0];
    case Knob::kField:
      break;
  }
  return layout.volume_mm.x();
}

DesignChange change_of(const SensorLayout& layout, Knob knob, double factor, double pixel_um) {
  DesignChange change;
  change.pixel_um = pixel_um;
  switch (knob) {
    case Knob::kBaseline:
      change.baseline_mm = factor * layout.baseline_mm;
      break;
    case Knob::kFocalLength:
      change.focal_mm = factor * camera_focal_mm(layout, pixel_um);
      break;
    case Knob::kLines:
      change.lines = {scaled_count(layout.line_counts[0], factor),
                      scaled_count(layout.line_counts[1], factor)};
      break;
    case Knob::kField:
      change.field_mm = factor * layout.volume_mm.head<2>();
      break;
  }
  return change;
}

}  // namespace

std::string_view to_string(Knob knob) {
  constexpr std::array<std::string_view, kKnobs.size()> kNames = {"baseline", "focal length",
                                                                  "lines", "field"};
  return kNames[static_cast<std::size_t>(knob)];
}

std::string_view unit_of(Knob knob) { return knob == Knob::kLines ? "" : "mm"; }

Result<std::vector<Sweep>> design_sweeps(const SensorLayout& layout, double pixel_um) {
  std::vector<Sweep> sweeps;
  for (const Knob knob : kKnobs) {
    Sweep sweep{knob, {}};
    for (const double factor : kFactors) {
      const auto other = factor == 1.0 ? Result<SensorLayout>(layout)
                                       : changed(layout, change_of(layout, knob, factor, pixel_um));
      // A number that is out of its range, such as too large a baseline, has no figures.
      if (!other) continue;
      const auto figures = design_figures(*other);
      if (!figures) return tl::unexpected(figures.error());
      sweep.points.push_back({factor, value_of(*other, knob, pixel_um), *figures});
    }
    sweeps.push_back(std::move(sweep));
  }
  return sweeps;
}

}  // namespace flytri::design
