#include "core/scan/scan_snapshot.h"

namespace flytri::scan {

std::int64_t FrameCounts::rejected_count() const {
  std::int64_t sum = 0;
  for (const auto& [reason, count] : rejected) sum += count;
  return sum;
}

}  // namespace flytri::scan
