/// @file  The dialog of flytri calibrate --live: asks for each target and judges its images.
#pragma once

#include <optional>
#include <string>

#include "core/base/progress.h"
#include "hw/shots/guided_session.h"

namespace flytri::cli {

/// Runs the session until it is complete and its calibration is good.
/// @param note  of the calibration's history
/// @return  nothing: the user stopped; what is done is kept
/// @errors  As GuidedSession::shoot, reopen and finish. If the set is refused, the dialog asks for
///          the plane to take again.
[[nodiscard]] Result<std::optional<calibration::GuidedFit>> run_guide_dialog(
    shots::GuidedSession& session, const std::string& note, const Workers& workers,
    const Progress& progress);

}  // namespace flytri::cli
