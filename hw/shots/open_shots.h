/// @file  Opens the source of calibration images that the user chose.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "hw/shots/shot_source.h"
#include "hw/simulated/optics/sensor_model.h"

namespace flytri::shots {

struct ShotChoice {
  bool simulated = false;
  std::string sensor = "intraoral";  ///< simulated sensor: "intraoral" or "face"
  std::filesystem::path rig = "rig.json";
  int exposures = 16;  ///< 1..256, averaged into each image
};

/// The paper's sensor for faces if the name is "face", else its intra-oral sensor.
[[nodiscard]] simulated::SensorModel sensor_named(const std::string& name);

/// Opens no device before ShotSource::start.
/// @errors  As read_rig and open_rig_shots.
[[nodiscard]] Result<std::shared_ptr<ShotSource>> open_shots(const ShotChoice& choice);

}  // namespace flytri::shots
