/// @file  Which events a scan accepts in which phase: by the state machine in
/// core/scan/scan_state.h.
#pragma once

#include "core/scan/scan_state.h"

namespace flytri::ui {

/// True if the event fits the phase. The only place in ui that decides this.
/// @param has_model  something was scanned
[[nodiscard]] inline bool accepts(scan::ScanPhase phase, scan::ScanEvent event, bool has_model) {
  if (event == scan::ScanEvent::kEdit) return phase != scan::ScanPhase::kFinishing;
  if (event == scan::ScanEvent::kFinish && phase == scan::ScanPhase::kFinished) return false;
  return scan::next_phase(phase, event, has_model) != phase;
}

/// True if the user may turn to another stage, case or calibration. While a scan is finishing, the
/// only choice is to wait or to cancel.
[[nodiscard]] constexpr bool may_leave(scan::ScanPhase phase) {
  return phase != scan::ScanPhase::kFinishing;
}

}  // namespace flytri::ui
