/// @file  Asks the user at the terminal.
#pragma once

#include <optional>
#include <string>

#include "core/base/progress.h"

namespace flytri::cli {

/// Reads lines from standard input; Ctrl-C works meanwhile.
class Prompt {
 public:
  explicit Prompt(Progress progress) : progress_(std::move(progress)) {}
  /// @return  nothing at the end of the input, and when the job is cancelled
  [[nodiscard]] std::optional<std::string> ask(const std::string& question);

 private:
  Progress progress_;
  std::string pending_;  // read, but not returned yet
};

}  // namespace flytri::cli
