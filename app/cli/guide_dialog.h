/// @file  The dialog of flytri calibrate --live: asks for the target, tells what each shot showed.
#pragma once

#include <optional>
#include <string>

#include "core/base/progress.h"
#include "hw/shots/guided_session.h"

namespace flytri::cli {

/// Reads lines from standard input without keeping Ctrl-C waiting.
class Prompt {
 public:
  explicit Prompt(Progress progress) : progress_(std::move(progress)) {}
  /// @return  nothing at the end of the input, and when the work is cancelled
  [[nodiscard]] std::optional<std::string> ask(const std::string& question);

 private:
  Progress progress_;
  std::string pending_;  // read, but not asked for yet
};

/// Guides through a session until it is complete and fits.
/// @return  nothing: the user stopped; what is done is kept
/// @errors  As GuidedSession::shoot, reopen and finish, apart from sets that are refused: then the
///          user is asked which plane to take again.
[[nodiscard]] Result<std::optional<calibration::GuidedFit>> run_guide_dialog(
    shots::GuidedSession& session, const Workers& workers, const Progress& progress);

}  // namespace flytri::cli
