/// @file  From the stamps of frames to the steady beat of the camera behind them.
#pragma once

#include <cstdint>
#include <deque>

#include "core/base/result.h"

namespace flytri::sync {

struct FrameClockOptions {
  double period_s = 1.0 / 30.0;  ///< > 0, what the camera promises; learned from its stamps
  int memory = 64;               ///< 8..1000, frames over which the beat is fitted
  /// 0..0.5 periods. A stamp is moved towards the beat by at most this: USB delays frames by less,
  /// and a camera that does not keep a beat is believed.
  double max_correction = 0.25;
  [[nodiscard]] Result<void> validate() const;
};

/// A camera exposes at equal times, but its stamps wait for the bus: a line is fitted through the
/// stamps over the number of the exposure.
class FrameClock {
 public:
  /// @param options  valid ones
  explicit FrameClock(const FrameClockOptions& options = {});

  /// @param stamp_s  rises from frame to frame
  /// @return  the stamp without its jitter; rises too
  double add(double stamp_s);

  [[nodiscard]] double period_s() const { return period_s_; }
  /// The stamp of the first exposure that comes after `time_s`, by the beat. Before the first
  /// frame: `time_s` itself.
  [[nodiscard]] double next_stamp_s(double time_s) const;

 private:
  struct Beat {
    std::int64_t number = 0;
    double stamp_s = 0.0;
  };
  void fit();
  [[nodiscard]] double beat_s(std::int64_t number) const;

  FrameClockOptions options_;
  std::deque<Beat> beats_;
  double period_s_;
  double origin_s_ = 0.0;  // of exposure 0, by the fit
  double last_s_ = 0.0;    // returned last
  int misses_ = 0;         // stamps in a row that were off the beat
};

}  // namespace flytri::sync
