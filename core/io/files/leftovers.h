/// @file  Temporary files that a killed program left behind: their names, and their removal.
#pragma once

#include <filesystem>
#include <string_view>

namespace flytri::io {

/// Names of hidden files of AtomicFile: a prefix and eight hexadecimal digits.
inline constexpr std::string_view kTemporaryPrefix = ".flytri-";
/// A second name of a file that is being replaced.
inline constexpr std::string_view kSecondNamePrefix = ".flytri-former-";
/// The only name of a file that is being replaced, on a disk without second names.
inline constexpr std::string_view kMovedPrefix = ".flytri-moved-";

/// Removes temporary files of killed programs from a folder; call it before writing there. Removed
/// are only files of this user with one of the first two names above, whose program has ended: it
/// holds a lock on them. Second names, and files on a disk without locks, are removed after a day;
/// logs of a database with their file.
/// Failures are passed over: the files are in nobody's way.
void remove_leftovers(const std::filesystem::path& folder);

}  // namespace flytri::io
