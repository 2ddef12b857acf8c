/// @file  From what a user names to the source of calibration images.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "hw/shots/shot_source.h"
#include "hw/simulated/optics/sensor_model.h"

namespace flytri::shots {

struct ShotChoice {
  bool simulated = false;
  std::string sensor = "intraoral";  ///< that is simulated: "intraoral" or "face"
  std::filesystem::path rig = "rig.json";
};

/// The sensor of the paper by its name: "face", or the intra-oral one.
[[nodiscard]] simulated::SensorModel sensor_named(const std::string& name);

/// No device is opened before ShotSource::start.
/// @errors  As read_rig and open_rig_shots.
[[nodiscard]] Result<std::shared_ptr<ShotSource>> open_shots(const ShotChoice& choice);

}  // namespace flytri::shots
