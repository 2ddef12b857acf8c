/// @file  How the dotted board shall be held in the poses of a calibration by hand.
#pragma once

#include <string>
#include <vector>

#include "core/geometry/rigid.h"

namespace flytri::calibration {

struct BoardPlace {
  double depth_share = 0.0;  ///< -0.5..0.5 of the volume's depth: where its middle is
  Vec2 nearer_deg =
      Vec2::Zero();       ///< how far its right and its lower edge are tilted to the sensor
  double turn_deg = 0.0;  ///< in its own plane, clockwise as the sensor sees it
  std::string words;      ///< for the user: "near, its left edge towards the sensor"
};

/// Three depths, and at each one flat and tilted to all sides: the tilts show the distance, from
/// which the depths follow, and together the poses fill the volume.
[[nodiscard]] std::vector<BoardPlace> board_places();

/// The pose of the board at such a place.
/// @param depth_mm  of the volume
[[nodiscard]] Isometry pose_of(const BoardPlace& place, double depth_mm);

}  // namespace flytri::calibration
