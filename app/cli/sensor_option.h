/// @file  The option that chooses one of the paper's sensors.
#pragma once

#include <string>

#include "app/cli/command.h"

namespace flytri::cli {

/// Adds --sensor, as shots::sensor_named() knows the names.
inline CLI::Option* add_sensor_option(CLI::App& command, std::string& sensor) {
  return command.add_option("--sensor", sensor, "Sensor of the paper: for teeth or for faces")
      ->check(CLI::IsMember({"intraoral", "face"}))
      ->capture_default_str();
}

}  // namespace flytri::cli
