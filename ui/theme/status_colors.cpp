#include "ui/theme/status_colors.h"

namespace flytri::ui {

Color status_color(scan::ScanPhase phase) {
  switch (phase) {
    case scan::ScanPhase::kMeasurement:
    case scan::ScanPhase::kFinished:
      return kGood;
    case scan::ScanPhase::kContinuation:
      return kBad;
    case scan::ScanPhase::kFinishing:
      return kCaution;
    case scan::ScanPhase::kPreview:
      break;
  }
  return kNeutral;
}

}  // namespace flytri::ui
