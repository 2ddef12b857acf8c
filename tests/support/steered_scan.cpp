#include "tests/support/steered_scan.h"

#include <chrono>
#include <cmath>
#include <utility>

#include "tests/support/orthographic_calibration.h"

namespace flytri::testing {

Isometry loop_pose(double time_s) {
  Twist twist;
  twist << 0.1 * std::sin(0.9 * time_s), 0.1 * std::cos(0.7 * time_s), 0.2 * std::sin(0.5 * time_s),
      6.0 * std::sin(0.55 * time_s), 5.0 * std::cos(0.8 * time_s), 0.5 * std::sin(1.1 * time_s);
  return exp_twist(twist);
}

Frame measurement_frame(int index) {
  Frame frame;
  frame.index = FrameIndex(index);
  frame.time_s = index * kFramePeriod_s;
  frame.kind = index % 2 == 0 ? FrameKind::kVertical : FrameKind::kHorizontal;
  frame.image = cv::Mat::zeros(48, 64, CV_8UC1);
  return frame;
}

double steady_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

scan::LiveScanOptions steered_options(
    std::function<Result<measurement::MeasuredView>(const Frame&)> measure_frame) {
  scan::LiveScanOptions options;
  options.now_s = steady_s;
  options.measure_frame = std::move(measure_frame);
  options.max_frames_underway = 1000;
  options.max_views_waiting = 1000;
  options.background = TaskThread::Priority::kNormal;
  return options;
}

std::unique_ptr<scan::LiveScan> make_scan(const scan::LiveScanOptions& options,
                                          const scan::KeptScan& kept) {
  auto calibration = std::make_shared<calibration::Calibration>(
      orthographic_calibration({20, 15, 15}, {64, 48}, 3.0));
  return std::move(scan::LiveScan::create(calibration, options, kept).value());
}

void offer(scan::LiveScan& scan, int begin, int end) {
  for (int i = begin; i < end; ++i) scan.offer(measurement_frame(i));
  scan.wait_until_idle();
}

std::shared_ptr<const scan::ScanSnapshot> finish(scan::LiveScan& scan) {
  scan.finish();
  scan.wait_until_idle();
  return scan.snapshot();
}

}  // namespace flytri::testing
