/// @file  The dialog of flytri calibrate --live: asks for each target and judges its images.
#pragma once

#include <optional>
#include <string>

#include "core/base/progress.h"
#include "hw/shots/guided_session.h"

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

/// Runs the session until it is complete and its calibration is good.
/// @return  nothing: the user stopped; what is done is kept
/// @errors  As GuidedSession::shoot, reopen and finish. If the set is refused, the dialog asks for
///          the plane to take again.
[[nodiscard]] Result<std::optional<calibration::GuidedFit>> run_guide_dialog(
    shots::GuidedSession& session, const Workers& workers, const Progress& progress);

}  // namespace flytri::cli
