/// @file  The options of all commands that scan: where the frames come from.
#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "app/cli/command.h"
#include "app/cli/object_options.h"
#include "app/cli/sensor_option.h"
#include "app/session/source.h"

namespace flytri::cli {

inline void add_source_options(CLI::App& command, session::SourceChoice& source) {
  std::vector<CLI::Option*> paths;
  for (const session::SourceRow& row : session::source_table()) {
    const auto choose = [&source, &row](const std::string& path) {
      source.name = row.name;
      source.path = path;
    };
    paths.push_back(
        command.add_option_function<std::string>(fmt::format("--{}", row.name), choose, row.help));
  }
  command.add_option("--calibration", source.calibration,
                     "Calibration to use. Default: the one that the source names");
  command
      .add_option("--speed", source.replay_speed,
                  "Speed of the replay; 1: as recorded, 0: as fast as possible")
      ->check(CLI::Range(0.0, 100.0))
      ->capture_default_str();
  const auto note = [&source](const std::string& /*value*/) { source.is_given = true; };
  CLI::Option* sensor = add_sensor_option(command, source.sensor)->each(note);
  for (CLI::Option* real : paths) real->excludes(sensor);
  for (CLI::Option* option : add_object_options(command, source.object))
    paths.push_back(option->each(note));
  for (CLI::Option* one : paths) {
    for (CLI::Option* other : paths) {
      if (one != other) one->excludes(other);
    }
  }
}

}  // namespace flytri::cli
