/// @file  Images of the dotted board of a calibration by hand, made once for a process.
#pragma once

#include "core/calibration/record/board_set.h"

namespace flytri::testing {

/// The virtual intra-oral sensor before a board that a steady hand holds.
[[nodiscard]] const calibration::BoardSet& hand_board();

/// A copy of pose 1. The other poses are not made: with sanitizers they take minutes.
[[nodiscard]] calibration::BoardPose one_board_pose();

}  // namespace flytri::testing
