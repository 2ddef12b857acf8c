/// @file  Measures the time of each stage. The caller passes the clock: core has none.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace flytri {

/// The time of one stage.
struct StageTime {
  std::string name;
  std::size_t item_count = 0;  ///< number of items that the stage processed
  std::string item_name;       ///< their kind: frames, views, points ...
  double seconds = 0.0;
};

/// Collects stage times.
class StageClock {
 public:
  /// @param now_s  monotonic seconds; empty: all times are 0
  explicit StageClock(std::function<double()> now_s) : now_s_(std::move(now_s)), start_s_(now()) {}

  /// Ends the stage that began at the end of the previous one.
  void end_stage(std::string name, std::size_t item_count, std::string item_name) {
    const double end_s = now();
    stages_.push_back({std::move(name), item_count, std::move(item_name), end_s - start_s_});
    start_s_ = end_s;
  }
  [[nodiscard]] double now() const { return now_s_ ? now_s_() : 0.0; }
  [[nodiscard]] const std::vector<StageTime>& stages() const { return stages_; }

 private:
  std::function<double()> now_s_;
  double start_s_;
  std::vector<StageTime> stages_;
};

}  // namespace flytri
