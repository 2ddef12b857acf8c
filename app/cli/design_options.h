/// @file  The options of all commands that work on a sensor that may differ from the paper's.
#pragma once

#include <string>
#include <vector>

#include "app/cli/command.h"
#include "hw/design/design_change.h"

namespace flytri::cli {

/// A sensor of the paper, and what is changed of it.
struct DesignArguments {
  std::string sensor = "intraoral";
  design::DesignChange change;
  std::vector<double> field_mm;  ///< empty, or width and height
  std::vector<int> lines;        ///< empty, or vertical and horizontal

  /// @errors  As design::changed.
  [[nodiscard]] Result<simulated::SensorLayout> layout() const;
  /// The sensor of the paper.
  [[nodiscard]] simulated::SensorLayout unchanged() const;
  [[nodiscard]] bool changes_anything() const;
};

/// Adds --sensor and the options of what is changed.
void add_design_options(CLI::App& command, DesignArguments& arguments);

}  // namespace flytri::cli
