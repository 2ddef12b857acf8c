/// @file  Files that appear complete or not at all, one by one or several together.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace flytri::io {

/// Who may read a new file.
enum class Access {
  kByUmask,    ///< as the user's umask says; a file that is replaced keeps its permissions
  kOwnerOnly,  ///< mode 0600, always: for what shows a patient's jaw
};

/// A file that is being written. The bytes go into a temporary file in the same folder; commit()
/// gives it its name. Without commit() nothing is left behind, and a former file stays as it was.
class AtomicFile {
 public:
  /// @errors  kNotFound (no such folder), kNotPermitted, kWriteFailed.
  [[nodiscard]] static Result<AtomicFile> create(const std::filesystem::path& path,
                                                 Access access = Access::kByUmask);
  AtomicFile(AtomicFile&& other) noexcept;
  AtomicFile& operator=(AtomicFile&& other) noexcept;
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  ~AtomicFile();

  /// @errors  kWriteFailed: the disk or quota is full, or the device fails.
  [[nodiscard]] Result<void> write(std::string_view bytes);
  /// Waits until the disk has all bytes; the file does not have its name yet.
  /// @errors  kWriteFailed.
  [[nodiscard]] Result<void> sync();
  /// Waits until the disk has all bytes, then renames. Write nothing afterwards.
  /// @errors  kWriteFailed, kNotPermitted.
  [[nodiscard]] Result<void> commit();
  /// Renames without waiting for the disk: the file survives the end of this process, but a power
  /// failure only after sync_file().
  /// @errors  As commit.
  [[nodiscard]] Result<void> commit_unsynced();

  /// As commit, but for a name that nothing has yet.
  /// @errors  As commit; kBadOption: a file of that name exists, and stays as it is.
  [[nodiscard]] Result<void> commit_new();

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// The temporary file, for a library that writes it by name.
  [[nodiscard]] const std::string& temporary() const { return temporary_; }

 private:
  AtomicFile(std::filesystem::path path, std::string temporary, int descriptor);
  void discard();
  /// Closes the file, and gives it its name by `rename`, which returns an errno.
  [[nodiscard]] Result<void> close_and_rename(int (*rename)(const char* from, const char* to));

  std::filesystem::path path_;
  std::string temporary_;
  int descriptor_ = -1;  ///< -1: committed, moved from or discarded
};

/// Commits files that belong together: all of them or none. They are renamed in this order, so put
/// the file that refers to the others last. After a failure each former file is back.
/// @errors  As AtomicFile::commit.
[[nodiscard]] Result<void> commit_together(std::vector<AtomicFile> files);

}  // namespace flytri::io
