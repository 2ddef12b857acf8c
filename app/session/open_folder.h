/// @file  Shows folders in the desktop's file manager.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "ui/text/texts.h"

namespace flytri::session {

/// Used by one thread.
class FolderOpener {
 public:
  /// Starts xdg-open, without a shell and apart from this program: it outlives it, sees none of its
  /// files, and a Ctrl-C in the terminal does not end it.
  /// @errors  kNotFound: there is no such folder, or no xdg-open.
  [[nodiscard]] Result<void> open(const std::filesystem::path& folder, const ui::Texts& texts = {});

  /// Looks which of the started programs have ended; call it now and then.
  /// @return  a message for each that failed
  [[nodiscard]] std::vector<std::string> settle(const ui::Texts& texts = {});

 private:
  struct Started {
    pid_t process;
    std::filesystem::path folder;
  };
  std::vector<Started> started_;
};

}  // namespace flytri::session
