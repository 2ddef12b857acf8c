/// @file  What the user may ask of a scan in each of its phases.
#pragma once

#include "core/scan/scan_state.h"

namespace flytri::ui {

enum class ScanRequest {
  kScan,         ///< start, pause or resume
  kFinish,       ///< compute the result
  kEdit,         ///< trim, lock, unlock, undo, redo
  kChoosePlace,  ///< another place to resume a lost scan
  kLeave         ///< another stage, an export, a calibration
};

/// The only place in ui that compares phases to decide what is possible.
[[nodiscard]] constexpr bool accepts(scan::ScanPhase phase, ScanRequest request) {
  using scan::ScanPhase;
  switch (request) {
    case ScanRequest::kFinish:
    case ScanRequest::kEdit:
      return phase != ScanPhase::kFinishing && phase != ScanPhase::kFinished;
    case ScanRequest::kChoosePlace:
      return phase == ScanPhase::kContinuation;
    case ScanRequest::kScan:
    case ScanRequest::kLeave:
      break;
  }
  return phase != ScanPhase::kFinishing;
}

}  // namespace flytri::ui
