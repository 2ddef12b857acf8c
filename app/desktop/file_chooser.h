/// @file  The desktop's own dialog to choose a file or a folder.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "core/base/result.h"

namespace flytri::desktop {

enum class ChooserKind { kOpenFile, kSaveFile, kFolder };

struct ChooserQuestion {
  ChooserKind kind = ChooserKind::kOpenFile;
  std::string title;
  std::filesystem::path now;  ///< where the dialog begins; empty: as the desktop has it
  std::string filter_name;    ///< of the files that are shown: "Cases"; empty: all files
  std::string filter_glob;    ///< "*.flytri"
};

struct ChooserAnswer {
  std::optional<std::filesystem::path> path;  ///< none: the user cancelled
  std::string failure;                        ///< why the dialog did not come; empty: it did
};

/// Asynchronous: no function waits. Used by one thread.
class FileChooser {
 public:
  virtual ~FileChooser() = default;
  FileChooser(const FileChooser&) = delete;
  FileChooser& operator=(const FileChooser&) = delete;

  /// Why there is no such dialog, and what to do; empty: there is one.
  [[nodiscard]] virtual std::string why_not() const = 0;
  /// Opens the dialog. Only one at a time.
  /// @errors  kNotFound: why_not(); kBadOption: a dialog is open.
  [[nodiscard]] virtual Result<void> ask(const ChooserQuestion& question) = 0;
  /// Call it often: lets the dialog go on. Returns the answer once.
  [[nodiscard]] virtual std::optional<ChooserAnswer> settle() = 0;

 protected:
  FileChooser() = default;
};

/// The portal of the desktop (org.freedesktop.portal.FileChooser), on the bus of the user's
/// session.
/// @source  XDG Desktop Portal, FileChooser version 3 and Request.
[[nodiscard]] std::unique_ptr<FileChooser> portal_file_chooser();

}  // namespace flytri::desktop
