/// @file  Reads a case whose first page was overwritten.
///
/// For the sources of core/io/cases only. The first page of a case says where its tables are. Every
/// case has them at the same places, so the first page of a new case can take its place.
#pragma once

#include <filesystem>
#include <string>

namespace flytri::io {

/// True if the file does not begin as a database does, but pages of tables follow where a case has
/// them. Never true for an encrypted case: without its first page nothing of it can be decrypted.
[[nodiscard]] bool has_lost_start(const std::filesystem::path& path);

/// The name under which SQLite opens a file as if it began with `page`, which is that of a new
/// case. The page of the first call serves for all.
[[nodiscard]] const char* file_system_with_start(const std::string& page);

}  // namespace flytri::io
