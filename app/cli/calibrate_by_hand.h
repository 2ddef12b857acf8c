/// @file  flytri calibrate --live --by-hand: a calibration on a dotted board, without a stage.
#pragma once

#include "app/cli/calibrate_live.h"
#include "core/calibration/fit/calibrate_board.h"

namespace flytri::cli {

[[nodiscard]] Result<void> calibrate_by_hand(const CalibrateLiveArguments& arguments,
                                             const Progress& progress);

/// Prints how well the poses fit each other.
void print_board_figures(const calibration::BoardCalibration& fitted);

}  // namespace flytri::cli
