#include "core/pipeline/scan_snapshot.h"

namespace flytri {

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

std::int64_t FrameCounts::rejected_count() const {
  std::int64_t sum = 0;
  for (const auto& [reason, count] : rejected) sum += count;
  return sum;
}

}  // namespace flytri
