/// @file  The user's settings on disk.
#pragma once

#include <filesystem>

#include "core/base/result.h"
#include "ui/state/app_view.h"

namespace flytri::session {

/// A file that is missing or damaged gives the defaults: settings are never worth a failure.
[[nodiscard]] ui::Settings read_settings(const std::filesystem::path& file);

/// @errors  As create_folder and write_file.
[[nodiscard]] Result<void> write_settings(const std::filesystem::path& file,
                                          const ui::Settings& settings);

}  // namespace flytri::session
