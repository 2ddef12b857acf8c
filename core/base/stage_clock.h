/// @file  Times the stages of a run with a clock that the caller brings: core has none of its own.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace flytri {

/// What one stage took.
struct StageTime {
  std::string name;
  std::size_t item_count = 0;  ///< how many things the stage worked on
  std::string item_name;       ///< what they are: frames, views, points ...
  double seconds = 0.0;
};

/// A list of stage times under construction.
class StageClock {
 public:
  /// @param now_s  monotonic seconds; empty: all times are 0
  explicit StageClock(std::function<double()> now_s) : now_s_(std::move(now_s)), start_s_(now()) {}

  /// Ends the stage that began when the last one ended.
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
