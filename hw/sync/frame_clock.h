/// @file  Removes the jitter from the time stamps of a camera that exposes at regular intervals.
#pragma once

#include <cstdint>
#include <deque>

#include "core/base/result.h"

namespace flytri::sync {

struct FrameClockOptions {
  double period_s = 1.0 / 30.0;  ///< > 0, nominal frame period; the true one is learned
  int memory = 64;               ///< 8..1000, number of frames in the fit
  /// 0..0.5 periods. Largest correction of a stamp. USB delays frames by less; if a camera's
  /// intervals are irregular, its stamps stay nearly unchanged.
  double max_correction = 0.25;
  [[nodiscard]] Result<void> validate() const;
};

/// A camera exposes at equal intervals, but its stamps are delayed by the bus. This class fits a
/// line through the stamps over the exposure number.
class FrameClock {
 public:
  /// @param options  must be valid
  explicit FrameClock(const FrameClockOptions& options = {});

  /// @param stamp_s  increases from frame to frame
  /// @return  the stamp without jitter; also increases
  double add(double stamp_s);

  [[nodiscard]] double period_s() const { return period_s_; }
  /// The expected stamp of the first exposure after `time_s`. Before the first frame: `time_s`.
  [[nodiscard]] double next_stamp_s(double time_s) const;

 private:
  struct NumberedStamp {
    std::int64_t number = 0;
    double stamp_s = 0.0;
  };
  void fit();
  [[nodiscard]] double fitted_stamp_s(std::int64_t number) const;

  FrameClockOptions options_;
  std::deque<NumberedStamp> stamps_;
  double period_s_;
  double origin_s_ = 0.0;  // fitted stamp of exposure 0
  double last_s_ = 0.0;    // last return value
  int misses_ = 0;         // consecutive stamps far from the fit
};

}  // namespace flytri::sync
