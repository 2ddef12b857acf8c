/// @file  Whole files in and out of memory; what is written appears at once or not at all.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace flytri::io {

/// A file on its way to its name: bytes go into a temporary in the same folder, which takes the
/// name at commit(). Destroyed before that, it leaves nothing behind and the old file untouched.
class AtomicFile {
 public:
  /// @errors  kNotFound (no such folder), kNotPermitted, kWriteFailed.
  [[nodiscard]] static Result<AtomicFile> create(const std::filesystem::path& path);
  AtomicFile(AtomicFile&& other) noexcept;
  AtomicFile& operator=(AtomicFile&& other) noexcept;
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  ~AtomicFile();

  /// @errors  kWriteFailed: disk full, quota, or a failing device.
  [[nodiscard]] Result<void> write(std::string_view bytes);
  /// Flushes to the device, closes and renames. Nothing may be written afterwards.
  /// @errors  kWriteFailed, kNotPermitted.
  [[nodiscard]] Result<void> commit();
  /// The same without waiting for the device: it outlives this process, but whether it outlives a
  /// power failure is known after sync_file().
  /// @errors  As commit.
  [[nodiscard]] Result<void> commit_unsynced();

 private:
  AtomicFile(std::filesystem::path path, std::string temporary, int descriptor);
  void discard();

  std::filesystem::path path_;
  std::string temporary_;
  int descriptor_ = -1;  ///< -1: committed, moved from or discarded
};

/// Whether write_file() could begin now, for who has long work before it. Leaves nothing behind.
/// @errors  As AtomicFile::create.
[[nodiscard]] Result<void> check_writable(const std::filesystem::path& path);

/// @errors  As AtomicFile.
[[nodiscard]] Result<void> write_file(const std::filesystem::path& path, std::string_view bytes);

/// Waits until the device has all bytes of a file.
/// @errors  kNotFound, kNotPermitted, kWriteFailed.
[[nodiscard]] Result<void> sync_file(const std::filesystem::path& path);

/// @errors  kNotFound, kNotPermitted, kBadFormat (a folder, or a device that fails while reading).
[[nodiscard]] Result<std::string> read_file(const std::filesystem::path& path);

/// Makes an empty file that nobody but its owner may read or write.
/// @errors  kBadOption: there is one of that name; as AtomicFile::create.
[[nodiscard]] Result<void> create_private_file(const std::filesystem::path& path);

/// Creates a folder with its parents; one that exists already is fine.
/// @errors  kNotPermitted, kWriteFailed.
[[nodiscard]] Result<void> create_folder(const std::filesystem::path& folder);

}  // namespace flytri::io
