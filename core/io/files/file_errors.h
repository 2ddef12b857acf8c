/// @file  Failures of the operating system as errors that say what to do. Only for core/io/files.
#pragma once

#include <filesystem>

#include "core/base/result.h"

namespace flytri::io {

/// @param error  an errno
[[nodiscard]] tl::unexpected<Error> write_failure(const std::filesystem::path& path, int error);

/// kBadOption.
[[nodiscard]] tl::unexpected<Error> file_exists(const std::filesystem::path& path);

/// @param error  an errno
[[nodiscard]] tl::unexpected<Error> read_failure(const std::filesystem::path& path, int error);

}  // namespace flytri::io
