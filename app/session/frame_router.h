/// @file  Passes the frames of the present sensor to the current scan.
#pragma once

#include <memory>
#include <mutex>

#include "core/scan/live_scan.h"

namespace flytri::session {

/// A sensor counts times and frame numbers from zero each time it starts, but in a scan they must
/// always rise. Thread-safe: frames come from the capture loop.
class FrameRouter {
 public:
  /// From now on frames go to this scan. Null: they are dropped.
  void set_scan(std::shared_ptr<scan::LiveScan> scan);
  /// Call it when a sensor starts: its first frame comes after all earlier frames.
  void begin_sensor();
  /// Continues after the last frame of a saved scan.
  void go_on_after(FrameIndex last, double last_time_s);

  void offer(Frame frame);

 private:
  std::mutex mutex_;
  std::shared_ptr<scan::LiveScan> scan_;
  double offset_s_ = 0.0;
  double last_time_s_ = 0.0;
  int next_index_ = 0;
};

}  // namespace flytri::session
