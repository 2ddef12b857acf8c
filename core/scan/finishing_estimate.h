/// @file  Estimates how much of finishing is done, and how long the rest takes.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/scan/scan_snapshot.h"

namespace flytri::scan {

/// What the time of finishing depends on.
struct FinishingWork {
  std::size_t lost_views = 0;  ///< not registered during the scan
  std::size_t views = 0;       ///< registered, with points
  std::size_t texture_frames = 0;
  double area_mm2 = 0.0;  ///< of the surface
};

/// Plans the time of each stage from the work, on a usual computer, and corrects it by the time
/// that was needed so far.
class FinishingEstimate {
 public:
  FinishingEstimate(const FinishingWork& work, double now_s);

  /// The shares of all stages together never decrease. The remaining time is not told before a few
  /// percent are done.
  [[nodiscard]] FinishingState at(const Progress::Snapshot& step, double now_s);

 private:
  struct Stage {
    std::string name;
    double planned_s = 0.0;
    double spent_s = 0.0;
  };
  void enter(const std::string& stage, double now_s);

  std::vector<Stage> stages_;  ///< in their order
  std::size_t current_ = 0;
  double began_s_ = 0.0;          ///< finishing
  double current_since_s_ = 0.0;  ///< the current stage
  double fraction_ = 0.0;         ///< told last
};

}  // namespace flytri::scan
