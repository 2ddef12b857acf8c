/// @file  The queue between the sensor and the measuring threads. Frames come in without waiting;
/// measured frames go out in the same order.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>

#include "core/measurement/measure_view.h"

namespace flytri::scan {

/// A frame and what was measured in it.
struct IntakeResult {
  Frame frame;
  double offered_at_s = 0.0;
  bool skipped = false;  ///< no thread was free in time: nothing was measured
  Result<measurement::MeasuredView> measured;
};

/// A bounded queue. When it is full, it skips the oldest frame that no thread has taken yet. So a
/// high load costs views, but the delay does not grow. Thread-safe.
class FrameIntake {
 public:
  /// A frame to measure.
  struct Task {
    std::uint64_t number = 0;
    Frame frame;
  };

  /// @param capacity  >= 1, frames that may wait to be measured, are being measured, or wait for
  ///                  earlier frames
  explicit FrameIntake(std::size_t capacity) : capacity_(capacity) {}

  /// Never blocks.
  void offer(Frame frame, double now_s);
  /// Waits for the next frame to measure. None: the intake was closed.
  [[nodiscard]] std::optional<Task> take();
  void deliver(std::uint64_t number, Result<measurement::MeasuredView> measured);

  /// Waits for the next result in order. None: wake() or close() was called.
  [[nodiscard]] std::optional<IntakeResult> next();
  /// Measured frames that are waiting for next(): how late its caller is.
  [[nodiscard]] std::size_t backlog() const;
  /// Lets a waiting next() return, so that its thread can do something else.
  void wake();
  /// Ends all waiting. The intake takes no more frames.
  void close();

 private:
  enum class State { kWaiting, kTaken, kDone };
  struct Slot {
    std::uint64_t number = 0;
    State state = State::kWaiting;
    IntakeResult result;
  };
  [[nodiscard]] Slot* first_waiting();

  const std::size_t capacity_;
  mutable std::mutex mutex_;
  std::condition_variable has_task_, has_result_;
  std::deque<Slot> slots_;      ///< by rising number
  std::size_t unfinished_ = 0;  ///< slots that are neither skipped nor delivered yet
  std::uint64_t next_number_ = 0;
  bool woken_ = false;
  bool closed_ = false;
};

}  // namespace flytri::scan
