/// @file  Hands the frames of whatever sensor runs to whatever scan is current.
#pragma once

#include <memory>
#include <mutex>

#include "core/scan/live_scan.h"

namespace flytri::session {

/// Sensors begin their times and numbers anew each time they start; a scan's times and numbers must
/// rise over all of them. Thread-safe: frames come from the capture loop.
class FrameRouter {
 public:
  /// Frames go to this scan from now on; null: they are let go.
  void set_scan(std::shared_ptr<scan::LiveScan> scan);
  /// A sensor starts: its first frame comes after all that were.
  void begin_sensor();
  /// Continues after frames that are kept already.
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
