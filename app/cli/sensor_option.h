/// @file  The options that choose one of the paper's sensors, and its number of lines.
#pragma once

#include <string>
#include <vector>

#include "app/cli/command.h"

namespace flytri::cli {

/// Adds --sensor, as shots::sensor_named() knows the names.
inline CLI::Option* add_sensor_option(CLI::App& command, std::string& sensor) {
  return command.add_option("--sensor", sensor, "Sensor of the paper: for teeth or for faces")
      ->check(CLI::IsMember({"intraoral", "face"}))
      ->capture_default_str();
}

/// Adds --lines. Not given: the numbers of the sensor.
inline CLI::Option* add_lines_option(CLI::App& command, std::vector<int>& lines) {
  return command.add_option("--lines", lines, "Number of vertical and horizontal lines, as V,H")
      ->delimiter(',')
      ->expected(2);
}

}  // namespace flytri::cli
