/// @file  Between the sensor and the workers: frames come in without ever waiting, measured frames
/// go out in the order they came.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>

#include "core/measurement/measure_view.h"

namespace flytri::scan {

/// What became of an offered frame.
struct IntakeResult {
  Frame frame;
  double offered_at_s = 0.0;
  bool skipped = false;  ///< no worker got to it in time: nothing was measured
  Result<measurement::MeasuredView> measured;
};

/// A bounded queue. When it is full, the oldest frame that no worker has begun is given up; so load
/// costs views, never time. Thread-safe.
class FrameIntake {
 public:
  /// A frame that a worker is to measure.
  struct Task {
    std::uint64_t number = 0;
    Frame frame;
  };

  /// @param capacity  >= 1, frames that may wait, be measured, or wait for those before them
  explicit FrameIntake(std::size_t capacity) : capacity_(capacity) {}

  /// Never blocks.
  void offer(Frame frame, double now_s);
  /// The next frame to be measured; waits for one. None: the intake was closed.
  [[nodiscard]] std::optional<Task> take();
  void deliver(std::uint64_t number, Result<measurement::MeasuredView> measured);

  /// The next result in order; waits for it. None: someone called wake() or close().
  [[nodiscard]] std::optional<IntakeResult> next();
  /// Measured frames that wait behind the next one: how late the caller of next() is.
  [[nodiscard]] std::size_t backlog() const;
  /// Lets a waiting next() return, so that its thread can see to something else.
  void wake();
  /// Ends all waiting, for good.
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
  std::size_t unfinished_ = 0;  ///< slots that are not yet given up or delivered
  std::uint64_t next_number_ = 0;
  bool woken_ = false;
  bool closed_ = false;
};

}  // namespace flytri::scan
