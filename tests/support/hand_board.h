/// @file  Images of the dotted board of a calibration by hand, made once for a process.
#pragma once

#include "core/calibration/record/board_set.h"

namespace flytri::testing {

/// The virtual intra-oral sensor before a board that a steady hand holds.
[[nodiscard]] const calibration::BoardSet& hand_board();

/// A copy of its pose 1. The others are not made for it: that takes minutes with sanitizers.
[[nodiscard]] calibration::BoardPose one_board_pose();

}  // namespace flytri::testing
