/// @file  The folders for the user's files.
/// @source  XDG Base Directory Specification, 0.8.
#pragma once

#include <filesystem>

namespace flytri::session {

[[nodiscard]] std::filesystem::path config_folder();         ///< settings
[[nodiscard]] std::filesystem::path cache_folder();          ///< files that can be computed again
[[nodiscard]] std::filesystem::path data_folder();           ///< cases
[[nodiscard]] std::filesystem::path unnamed_cases_folder();  ///< scans that have no case yet
[[nodiscard]] std::filesystem::path documents_folder();      ///< exported files

}  // namespace flytri::session
