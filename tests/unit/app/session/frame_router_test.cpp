#include "app/session/frame_router.h"

#include <gtest/gtest.h>

#include <chrono>

#include "tests/support/orthographic_calibration.h"

namespace flytri::session {
namespace {

std::shared_ptr<scan::LiveScan> make_scan() {
  scan::LiveScanOptions options;
  options.now_s = [] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
  };
  options.max_frames_underway = 100;
  options.measure_frame = [](const Frame& frame) {
    measurement::MeasuredView measured;
    measured.view.frame = frame.index;
    return measured;
  };
  return std::move(
      scan::LiveScan::create(std::make_shared<calibration::Calibration>(
                                 testing::orthographic_calibration({20, 15, 15}, {64, 48}, 3.0)),
                             options)
          .value());
}

Frame frame_at(double time_s) {
  Frame frame;
  frame.time_s = time_s;
  frame.kind = FrameKind::kVertical;
  frame.image = cv::Mat::zeros(48, 64, CV_8UC1);
  return frame;
}

/// The latest frame of the scan.
Frame last_frame(const scan::LiveScan& scan) {
  scan.wait_until_idle();
  return scan.snapshot()->latest[0]->frame;
}

TEST(FrameRouter, TimesAndNumbersRiseWhenTheSensorRestarts) {
  const auto scan = make_scan();
  FrameRouter router;
  router.set_scan(scan);
  router.begin_sensor();
  for (const double time_s : {0.0, 0.1, 0.2}) router.offer(frame_at(time_s));
  const Frame first = last_frame(*scan);
  EXPECT_EQ(first.index, FrameIndex(2));
  router.begin_sensor();
  router.offer(frame_at(0.0));
  const Frame second = last_frame(*scan);
  EXPECT_EQ(second.index, FrameIndex(3));
  EXPECT_GT(second.time_s, first.time_s + 0.5);
}

TEST(FrameRouter, ContinuesAfterTheFramesOfACase) {
  const auto scan = make_scan();
  FrameRouter router;
  router.set_scan(scan);
  router.begin_sensor();
  router.go_on_after(FrameIndex(41), 100.0);
  router.offer(frame_at(0.0));
  EXPECT_EQ(last_frame(*scan).index, FrameIndex(42));
  EXPECT_GT(last_frame(*scan).time_s, 100.0);
}

TEST(FrameRouter, DropsFramesWithoutAScan) {
  const auto scan = make_scan();
  FrameRouter router;
  router.offer(frame_at(0.0));
  router.set_scan(scan);
  router.set_scan(nullptr);
  router.offer(frame_at(0.1));
  scan->wait_until_idle();
  EXPECT_EQ(scan->snapshot()->counts.offered, 0);
}

}  // namespace
}  // namespace flytri::session
