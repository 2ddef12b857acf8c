/// @file  Reads and writes the user's settings.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "ui/state/app_view.h"

namespace flytri::session {

/// Where the program keeps them.
[[nodiscard]] std::filesystem::path settings_path();

/// What is missing, unknown or out of its range gets its default.
[[nodiscard]] ui::Settings parse_settings(std::string_view text);
[[nodiscard]] std::string settings_to_json(const ui::Settings& settings);

/// If the file is missing or damaged, returns the defaults.
[[nodiscard]] ui::Settings read_settings(const std::filesystem::path& file);

/// @errors  As create_folder and write_file.
[[nodiscard]] Result<void> write_settings(const std::filesystem::path& file,
                                          const ui::Settings& settings);

}  // namespace flytri::session
