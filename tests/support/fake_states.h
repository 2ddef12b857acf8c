/// @file  Names of the states that FakeScan provides.
#pragma once

#include <array>

namespace flytri::testing {

inline constexpr std::array kFakeStates = {
    "ready",       "preview",      "scanning",    "near",       "paused",
    "lost",        "finishing",    "finished",    "failed",     "no_sensor",
    "empty_case",  "unnamed",      "not_saved",   "devices",    "devices_wrong",
    "calibrating", "shot_refused", "set_refused", "calibrated", "check_broken"};

}  // namespace flytri::testing
