/// @file  Reads a passphrase from a file, without leaving copies in memory.
#pragma once

#include <filesystem>

#include "core/base/result.h"
#include "core/base/secret.h"

namespace flytri::io {

/// The first line of a file, at most 1000 bytes long. Reads from pipes, too: `<(pass show clinic)`.
/// @errors  As read_file; kBadFormat: the line is longer, or has a zero byte.
[[nodiscard]] Result<Secret> read_secret(const std::filesystem::path& path);

}  // namespace flytri::io
