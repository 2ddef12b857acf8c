/// @file  The states of the program that its window can be shown in without pipeline and devices.
#pragma once

#include <array>

namespace flytri::testing {

/// By name, as `tell NAME` asks for them.
inline constexpr std::array kFakeStates = {
    "ready",         "preview",     "scanning",     "near",        "paused",     "lost",
    "finishing",     "finished",    "failed",       "no_sensor",   "empty_case", "devices",
    "devices_wrong", "calibrating", "shot_refused", "set_refused", "calibrated", "check_broken"};

}  // namespace flytri::testing
