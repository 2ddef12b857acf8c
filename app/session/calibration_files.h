/// @file  Where the window keeps calibrations, and how one of them is taken into use.
#pragma once

#include <filesystem>

#include "app/session/source.h"

namespace flytri::session {

/// The latest of the folders in `calibrations` in which a calibration was begun and is not done, or
/// else a new one, named by date and time. Nothing is created.
[[nodiscard]] std::filesystem::path propose_calibration_folder(
    const std::filesystem::path& calibrations);

/// From now on the rig measures with the calibration: it takes the place of the one that the user
/// or rig.json names; where none is named, rig.json is made to name it. The one before stays beside
/// it, the time in its name.
/// @param choice  of a rig
/// @return  the file that is in use now
/// @errors  As read_file, parse_rig, write_file.
[[nodiscard]] Result<std::filesystem::path> adopt_calibration(
    const SourceChoice& choice, const std::filesystem::path& calibration);

}  // namespace flytri::session
