/// @file  The way from where a lost sensor probably is to the place where the scan can be resumed.
#pragma once

#include <optional>
#include <string>

#include "core/scan/scan_snapshot.h"
#include "ui/text/texts.h"

namespace flytri::ui {

struct WayBack {
  Isometry T_world_sensor = Isometry::Identity();  ///< where the sensor probably is
  Isometry T_world_place = Isometry::Identity();   ///< where the scan can be resumed
  double tilt_rad = 0.0;                           ///< between the two lines of sight
  bool is_featureless = false;  ///< the surface at the sensor does not fix its pose

  [[nodiscard]] double distance_mm() const {
    return (T_world_place.translation() - T_world_sensor.translation()).norm();
  }
};

/// None unless tracking is lost and the sensor is probably over the scan.
[[nodiscard]] std::optional<WayBack> way_back(const scan::ScanSnapshot& scan);

/// What to do, in a few words.
[[nodiscard]] std::string words_of(const WayBack& way, const Texts& texts);

}  // namespace flytri::ui
