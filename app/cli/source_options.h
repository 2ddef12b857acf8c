/// @file  The options of all commands that scan: where the frames come from.
#pragma once

#include <fmt/format.h>

#include "app/cli/command.h"
#include "app/session/source.h"
#include "core/io/models/model_formats.h"

namespace flytri::cli {

inline void add_source_options(CLI::App& command, session::SourceChoice& source) {
  const auto recording = command.add_option(
      "--recording", source.recording, "Replay this recording instead of using the virtual sensor");
  const auto rig =
      command.add_option("--rig", source.rig, "Scan with the devices that this rig.json describes")
          ->excludes(recording);
  command.add_option("--calibration", source.calibration,
                     "Calibration to use. Default: the one that the recording or rig names");
  command
      .add_option("--speed", source.replay_speed,
                  "Speed of the replay; 1: as recorded, 0: as fast as possible")
      ->check(CLI::Range(0.0, 100.0))
      ->capture_default_str();
  command
      .add_option("--mesh", source.mesh,
                  fmt::format("Model that the virtual sensor scans ({}). Default: the sample jaw",
                              io::extension_list(io::FormatUse::kRead)))
      ->excludes(recording)
      ->excludes(rig);
}

}  // namespace flytri::cli
