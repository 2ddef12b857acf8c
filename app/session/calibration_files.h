/// @file  Finds the folders of calibrations, takes a calibration into use, and notes its checks.
#pragma once

#include <filesystem>

#include "app/session/source.h"

namespace flytri::session {

/// The latest folder in `calibrations` with an unfinished calibration. If there is none, the name
/// of a new folder, with date and time. Creates nothing.
[[nodiscard]] std::filesystem::path propose_calibration_folder(
    const std::filesystem::path& calibrations);

/// Lets the rig measure with this calibration. It replaces the file that the user or rig.json
/// names. If there is no such file, it is created and named in rig.json. The earlier file is
/// kept beside it, with date and time in its name; the new one continues its history. A calibration
/// that is in use already stays as it is.
/// @param choice  a source with a rig
/// @return  the file that is in use now
/// @errors  As read_calibration, parse_rig, write_file.
[[nodiscard]] Result<std::filesystem::path> adopt_calibration(
    const SourceChoice& choice, const std::filesystem::path& calibration);

/// A check that ended now.
/// @param note  see CalibrationCheck
[[nodiscard]] calibration::CalibrationCheck checked_now(bool has_passed, const std::string& note);

/// Adds a check to those that the file of the calibration has.
/// @param checked  what was checked
/// @errors  As read_calibration and write_file; kNotPermitted: the file is read-only;
///          kInconsistent: another calibration has taken its place in the file.
[[nodiscard]] Result<void> note_check(const std::filesystem::path& file,
                                      const calibration::Calibration& checked,
                                      const calibration::CalibrationCheck& check);

}  // namespace flytri::session
