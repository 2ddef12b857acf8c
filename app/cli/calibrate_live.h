/// @file  flytri calibrate --live: a guided calibration with a rig, or with the virtual sensor.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/cli/command.h"
#include "core/calibration/guide/calibration_plan.h"

namespace flytri::cli {

/// Sensor and targets, where they differ from those in the paper.
struct PlanArguments {
  std::string sensor = "intraoral";
  std::vector<double> volume_mm;  ///< x, y, z; empty: not given
  std::vector<int> lines;         ///< vertical, horizontal; empty: not given
  std::vector<double> dots_mm;    ///< pitch, diameter, large diameter; empty: not given
  int planes = 0;                 ///< 0: not given
  bool by_target = false;
};

struct CalibrateLiveArguments {
  PlanArguments plan;
  std::filesystem::path rig = "rig.json";
  bool simulated = false;
  std::filesystem::path output;
  std::string note;  ///< of the calibration's history
  int thread_count = 0;
};

void add_plan_options(CLI::App& command, PlanArguments& plan);

[[nodiscard]] Result<void> calibrate_live(const CalibrateLiveArguments& arguments,
                                          const Progress& progress);

/// Prints RMS and maximum of the residuals of the fits.
void print_residuals(const calibration::Calibration& calibration);

}  // namespace flytri::cli
