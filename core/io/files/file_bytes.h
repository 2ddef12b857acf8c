/// @file  Reads and writes whole files; a written file appears complete or not at all.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/io/files/atomic_file.h"

namespace flytri::io {

/// Whether write_file() could start now: call it before long work. Leaves nothing behind.
/// @errors  As AtomicFile::create.
[[nodiscard]] Result<void> check_writable(const std::filesystem::path& path);

/// @errors  As AtomicFile.
[[nodiscard]] Result<void> write_file(const std::filesystem::path& path, std::string_view bytes,
                                      Access access = Access::kByUmask);

/// Waits until the disk has all bytes of a file.
/// @errors  kNotFound, kNotPermitted, kWriteFailed.
[[nodiscard]] Result<void> sync_file(const std::filesystem::path& path);

/// @errors  kNotFound, kNotPermitted, kBadFormat (not a file, or reading fails).
[[nodiscard]] Result<std::string> read_file(const std::filesystem::path& path);

/// Creates a folder and its parents, unless it exists.
/// @errors  kNotPermitted, kWriteFailed.
[[nodiscard]] Result<void> create_folder(const std::filesystem::path& folder);

/// Creates a folder and its parents, unless it exists. Only their owner may enter those that it
/// creates; one that exists stays as it is.
/// @errors  kNotPermitted, kWriteFailed, kNotFound (a parent is a file).
[[nodiscard]] Result<void> create_private_folder(const std::filesystem::path& folder);

}  // namespace flytri::io
