/// @file  Where shaders, fonts and other assets lie at run time.
#pragma once

#include <filesystem>
#include <string_view>

#include "core/base/result.h"

namespace flytri::ui {

/// The file of an asset such as "shaders/splat.vert". If $FLYTRI_ASSETS is set, only that folder is
/// searched; otherwise ../share/flytri beside the program, which in a build folder is a link to the
/// source tree.
/// @errors  kNotFound, with the places that were tried.
[[nodiscard]] Result<std::filesystem::path> asset_path(std::string_view name);

/// The content of an asset.
/// @errors  kNotFound, kNotPermitted.
[[nodiscard]] Result<std::string> read_asset(std::string_view name);

}  // namespace flytri::ui
