/// @file  Where a program keeps what belongs to its user.
/// @source  XDG Base Directory Specification, 0.8.
#pragma once

#include <filesystem>

namespace flytri::session {

[[nodiscard]] std::filesystem::path config_folder();     ///< settings
[[nodiscard]] std::filesystem::path cache_folder();      ///< what can be made again
[[nodiscard]] std::filesystem::path data_folder();       ///< cases
[[nodiscard]] std::filesystem::path documents_folder();  ///< what the user takes elsewhere

}  // namespace flytri::session
