/// @file  The path that a file:// address means.
/// @source  RFC 8089.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

namespace flytri::desktop {

/// @return  none if the address is not that of a file on this computer
[[nodiscard]] std::optional<std::filesystem::path> path_of_uri(std::string_view uri);

}  // namespace flytri::desktop
