/// @file  Images of the dotted board of a calibration by hand, made once for a process.
#pragma once

#include "core/calibration/record/board_set.h"

namespace flytri::testing {

/// The virtual intra-oral sensor before a board that a steady hand holds.
[[nodiscard]] const calibration::BoardSet& hand_board();

/// A copy that shares no pixels with it.
[[nodiscard]] calibration::BoardPose hand_board_pose(std::size_t index);

}  // namespace flytri::testing
