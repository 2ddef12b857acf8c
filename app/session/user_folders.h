/// @file  The folders for the user's files.
/// @source  XDG Base Directory Specification, 0.8.
///
/// The functions that return a folder require check_user_folders().
#pragma once

#include <filesystem>
#include <string>

#include "core/base/result.h"
#include "ui/text/texts.h"

namespace flytri::session {

/// Whether there are such folders: the program must not choose a place for a patient's files that
/// nobody asked for.
/// @errors  kNotFound: HOME is not set, nor the variable for one of the folders.
[[nodiscard]] Result<void> check_user_folders();

/// @errors  kNotFound: HOME is not set.
[[nodiscard]] Result<std::filesystem::path> home_folder();

/// The folder as the user typed it, where ~ at the beginning is the home folder.
/// @errors  kBadOption: nothing was typed, or the home folder of somebody else; as home_folder.
[[nodiscard]] Result<std::filesystem::path> typed_folder(const std::string& typed,
                                                         const ui::Texts& texts);

[[nodiscard]] std::filesystem::path config_folder();         ///< settings
[[nodiscard]] std::filesystem::path cache_folder();          ///< files that can be computed again
[[nodiscard]] std::filesystem::path data_folder();           ///< cases
[[nodiscard]] std::filesystem::path recordings_folder();     ///< raw frames
[[nodiscard]] std::filesystem::path unnamed_cases_folder();  ///< scans that have no case yet
[[nodiscard]] std::filesystem::path documents_folder();      ///< exported files

}  // namespace flytri::session
