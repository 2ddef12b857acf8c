/// @file  The figures of a sensor's design as tables for the terminal and as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <vector>

#include "hw/design/design_figures.h"
#include "hw/design/design_sweep.h"

namespace flytri::cli {

inline constexpr const char* kDesignFormat = "flytri.design";

/// A sensor, and what it can do.
struct Design {
  simulated::SensorLayout layout;
  design::DesignFigures figures;
};

/// What `flytri design` shows.
struct DesignReport {
  double pixel_um = 0.0;
  double projector_focal_mm = 0.0;  ///< 0: not given
  Design described;
  std::optional<Design> changed;
  std::vector<design::Sweep> sweeps;  ///< of the changed sensor, or else of the described one

  [[nodiscard]] const Design& shown() const { return changed ? *changed : described; }
};

void print_design(const DesignReport& report);
[[nodiscard]] nlohmann::ordered_json to_json(const DesignReport& report);

}  // namespace flytri::cli
