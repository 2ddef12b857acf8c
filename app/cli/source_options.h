/// @file  The options of every subcommand that scans: where the frames come from.
#pragma once

#include "app/cli/command.h"
#include "app/session/source.h"

namespace flytri::cli {

inline void add_source_options(CLI::App& command, session::SourceChoice& source) {
  const auto recording = command.add_option("--recording", source.recording,
                                            "A recording to replay instead of the virtual sensor");
  const auto rig =
      command.add_option("--rig", source.rig, "A rig.json: the devices that are scanned with")
          ->excludes(recording);
  command.add_option("--calibration", source.calibration,
                     "Instead of the one that recording or rig names");
  command.add_option("--speed", source.replay_speed, "Of the replay; 0: as fast as it goes")
      ->check(CLI::Range(0.0, 100.0))
      ->capture_default_str();
  command
      .add_option("--mesh", source.mesh,
                  "What the virtual sensor scans instead of the sample jaw (.ply, .glb)")
      ->excludes(recording)
      ->excludes(rig);
}

}  // namespace flytri::cli
