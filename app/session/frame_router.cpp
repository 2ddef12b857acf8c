#include "app/session/frame_router.h"

#include <algorithm>
#include <utility>

namespace flytri::session {
namespace {

/// Time between the last frame of one sensor and the first of the next: longer than any gap over
/// which poses are interpolated.
constexpr double kBetweenSensors_s = 1.0;

}  // namespace

void FrameRouter::set_scan(std::shared_ptr<scan::LiveScan> scan) {
  // The former scan may be destroyed here. That takes a moment, so it is done without the lock.
  const std::lock_guard lock(mutex_);
  scan_.swap(scan);
}

void FrameRouter::begin_sensor() {
  const std::lock_guard lock(mutex_);
  offset_s_ = last_time_s_ + kBetweenSensors_s;
}

void FrameRouter::go_on_after(FrameIndex last, double last_time_s) {
  const std::lock_guard lock(mutex_);
  next_index_ = std::max(next_index_, last.value + 1);
  const double behind_s = last_time_s + kBetweenSensors_s - last_time_s_;
  if (behind_s <= 0.0) return;
  offset_s_ += behind_s;
  last_time_s_ += behind_s;
}

void FrameRouter::offer(Frame frame) {
  const std::lock_guard lock(mutex_);
  frame.time_s += offset_s_;
  last_time_s_ = frame.time_s;
  frame.index = FrameIndex(next_index_++);
  if (scan_) scan_->offer(std::move(frame));
}

}  // namespace flytri::session
