#include "core/scan/scan_state.h"

namespace flytri::scan {

std::string_view to_string(ScanPhase phase) {
  switch (phase) {
    case ScanPhase::kPreview:
      return "preview";
    case ScanPhase::kMeasurement:
      return "measurement";
    case ScanPhase::kContinuation:
      return "continuation";
    case ScanPhase::kFinishing:
      return "finishing";
    case ScanPhase::kFinished:
      return "finished";
  }
  return "";
}

ScanPhase next_phase(ScanPhase phase, ScanEvent event, bool has_model) {
  switch (event) {
    case ScanEvent::kStart:
      if (phase != ScanPhase::kPreview && phase != ScanPhase::kFinished) return phase;
      return has_model ? ScanPhase::kContinuation : ScanPhase::kMeasurement;
    case ScanEvent::kPause:
      return is_scanning(phase) ? ScanPhase::kPreview : phase;
    case ScanEvent::kRegistered:
      return phase == ScanPhase::kContinuation ? ScanPhase::kMeasurement : phase;
    case ScanEvent::kLost:
      return phase == ScanPhase::kMeasurement ? ScanPhase::kContinuation : phase;
    case ScanEvent::kFinish:
      if (phase == ScanPhase::kFinished) return phase;
      return has_model ? ScanPhase::kFinishing : phase;
    case ScanEvent::kResult:
      return phase == ScanPhase::kFinishing ? ScanPhase::kFinished : phase;
    case ScanEvent::kNoResult:
      return phase == ScanPhase::kFinishing ? ScanPhase::kPreview : phase;
    case ScanEvent::kEdit:
      return phase == ScanPhase::kFinished ? ScanPhase::kPreview : phase;
  }
  return phase;
}

bool accepts(ScanPhase phase, ScanEvent event, bool has_model) {
  if (event == ScanEvent::kEdit) return phase != ScanPhase::kFinishing;
  return next_phase(phase, event, has_model) != phase;
}

}  // namespace flytri::scan
