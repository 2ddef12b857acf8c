/// @file  Names of the states that FakeScan provides.
#pragma once

#include <array>

namespace flytri::testing {

inline constexpr std::array kFakeStates = {
    "ready",       "preview",    "scanning",     "near",          "tongue_gone",  "paused",
    "lost",        "finishing",  "finished",     "failed",        "no_sensor",    "empty_case",
    "unnamed",     "not_saved",  "devices",      "devices_wrong", "calibrating",  "shot_refused",
    "set_refused", "calibrated", "check_broken", "lost_smooth",   "damaged",      "cleared",
    "recording",   "bite",       "closing",      "jaws",          "jaws_refused", "prepared",
    "reviewed",    "other_side", "two_bites",    "scan_body",     "preop",        "setting_up",
    "setup_asks",  "set_up",     "setup_failed", "flat"};

/// States of the export dialog, all of a finished scan: files exist, they are being written, they
/// were written, it failed.
inline constexpr std::array kExportStates = {"export_exists", "exporting", "exported",
                                             "export_failed"};

}  // namespace flytri::testing
