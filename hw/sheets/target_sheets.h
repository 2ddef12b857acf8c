/// @file  Sheets to print: the targets of a stage, and the dotted board of a calibration by hand.
#pragma once

#include "hw/sheets/sheet.h"
#include "hw/simulated/optics/sensor_model.h"

namespace flytri::sheets {

/// A target sheet. The middle of the dot (0, 0), or of the board, is at `sheet.middle_mm`; x and y
/// of the sensor frame point to the right and down.
struct TargetSheet {
  Sheet sheet;
  Vec2 least_mm = Vec2::Zero();  ///< of the target, relative to its origin
  Vec2 most_mm = Vec2::Zero();
};

/// The dots of a calibration::DotTarget, white on black. They fill the measurement camera's image.
/// @param z_mm  depth of the farthest plane of the calibration
/// @errors  kBadOption: dots that overlap, or a target that is too large for A0.
[[nodiscard]] Result<TargetSheet> dot_sheet(const simulated::SensorModel& sensor, double z_mm);

/// The board of a calibration by hand: black dots on white, as SensorModel::board_dots.
/// @param z_mm, @errors  As dot_sheet.
[[nodiscard]] Result<TargetSheet> hand_board_sheet(const simulated::SensorModel& sensor,
                                                   double z_mm);

/// The white plane of a calibration and of its check. Marks show what the measurement camera sees.
/// @errors  kBadOption: a board that is too large for A0.
[[nodiscard]] Result<TargetSheet> board_sheet(const simulated::SensorModel& sensor, double z_mm);

}  // namespace flytri::sheets
