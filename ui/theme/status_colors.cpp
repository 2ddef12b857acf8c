#include "ui/theme/status_colors.h"

namespace flytri::ui {

Color status_color(ScanPhase phase) {
  switch (phase) {
    case ScanPhase::kMeasurement:
    case ScanPhase::kFinished:
      return kGood;
    case ScanPhase::kContinuation:
      return kBad;
    case ScanPhase::kFinishing:
      return kCaution;
    case ScanPhase::kPreview:
      break;
  }
  return kNeutral;
}

}  // namespace flytri::ui
