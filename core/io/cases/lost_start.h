/// @file  Reads a case whose first page was overwritten.
///
/// For the sources of core/io/cases only. The first page of a case says where its tables are. Every
/// case has them at the same places, so the first page of a new case can take its place.
#pragma once

#include <filesystem>
#include <string>

namespace flytri::io {

/// True if the start of the file is not that of a database, but the tables of a case follow. False
/// for an encrypted case, which cannot be read without its first page.
[[nodiscard]] bool has_lost_start(const std::filesystem::path& path);

/// Makes SQLite read `page`, of a new case, as the first page of a file.
/// @return  the file system to open the file with; all have the page of the first call
[[nodiscard]] const char* file_system_with_start(const std::string& page);

}  // namespace flytri::io
