/// @file  Counts the fate of each frame exactly once.
#pragma once

#include <map>
#include <string>

#include "core/scan/scan_snapshot.h"

namespace flytri::scan {

/// Frames are identified by their time.
class FrameCounter {
 public:
  void previewed() { ++counts_.previewed; }
  void registered() { ++counts_.registered; }
  void interpolated() { ++counts_.interpolated; }
  void textured() { ++counts_.textured; }
  void skipped() { ++counts_.skipped; }
  void rejected(double time_s, const std::string& reason) {
    ++counts_.rejected[reason];
    reasons_[time_s] = reason;
  }
  /// A view that was rejected at first is registered now.
  void found(double time_s) {
    const auto known = reasons_.find(time_s);
    if (known == reasons_.end()) return;
    if (--counts_.rejected[known->second] == 0) counts_.rejected.erase(known->second);
    reasons_.erase(known);
    ++counts_.registered;
  }

  /// @param offered  frames so far; frames without a fate count as pending
  [[nodiscard]] FrameCounts counts(std::int64_t offered) const {
    FrameCounts counts = counts_;
    counts.offered = offered;
    counts.pending = offered - counts.previewed - counts.registered - counts.interpolated -
                     counts.textured - counts.skipped - counts.rejected_count();
    return counts;
  }

 private:
  FrameCounts counts_;
  std::map<double, std::string> reasons_;
};

}  // namespace flytri::scan
