/// @file  Names of the fake states that the window can show.
#pragma once

#include <array>

namespace flytri::testing {

/// For the request `tell NAME`.
inline constexpr std::array kFakeStates = {
    "ready",         "preview",     "scanning",     "near",        "paused",     "lost",
    "finishing",     "finished",    "failed",       "no_sensor",   "empty_case", "devices",
    "devices_wrong", "calibrating", "shot_refused", "set_refused", "calibrated", "check_broken"};

}  // namespace flytri::testing
