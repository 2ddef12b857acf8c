#include "hw/recording/replay_sensor.h"

#include <gtest/gtest.h>

#include <fstream>
#include <thread>

#include "core/io/calibrations/calibration_file.h"
#include "core/io/calibrations/calibration_json.h"
#include "hw/device/capture_loop.h"
#include "tests/support/manual_clock.h"
#include "tests/support/small_calibration.h"
#include "tests/support/temporary_folder.h"

namespace flytri::recording {
namespace {

using testing::ManualClock;

// Ten frames at 10 Hz; the first at 3 s, because recordings need not start at 0.
class ReplayTest : public ::testing::Test {
 protected:
  void SetUp() override {
    io::RecordingWriter writer = io::RecordingWriter::create(folder_.path()).value();
    for (int i = 0; i < 10; ++i) {
      const cv::Mat image(24, 32, CV_8UC1, cv::Scalar(i));
      ASSERT_TRUE(writer.append({FrameIndex(i), FrameKind::kVertical, 3.0 + 0.1 * i, image}));
    }
    ASSERT_TRUE(writer.write_list());
  }
  std::shared_ptr<ReplaySensor> open(double speed) const {
    return ReplaySensor::open(folder_.path(), {.speed = speed}, clock_.clock()).value();
  }

  TemporaryFolder folder_;
  ManualClock clock_;
};

TEST_F(ReplayTest, ReplaysAtAMultipleOfTheRecordedSpeed) {
  const auto sensor = open(2.0);
  ASSERT_TRUE(sensor->start());
  const double start_s = clock_.now_s();
  for (int i = 0; i < 10; ++i) {
    const auto frame = sensor->next(1.0).value();
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->index.value, i);
    EXPECT_DOUBLE_EQ(frame->time_s, 3.0 + 0.1 * i);
    EXPECT_NEAR(clock_.now_s() - start_s, 0.05 * i, 1e-6);
  }
  EXPECT_EQ(sensor->status().state, device::SensorState::kEnded);
  EXPECT_FALSE(sensor->next(1.0).value());
}

TEST_F(ReplayTest, WaitsNoLongerThanTheTimeout) {
  const auto sensor = open(1.0);
  ASSERT_TRUE(sensor->start());
  EXPECT_TRUE(sensor->next(0.03).value());
  EXPECT_FALSE(sensor->next(0.03).value());
  EXPECT_NEAR(clock_.now_s(), 100.03, 1e-6);
}

TEST_F(ReplayTest, SkipsAndReportsADamagedFrame) {
  std::ofstream(folder_.path() / "frames/000004.png") << "no image";
  std::filesystem::remove(folder_.path() / "frames/000007.png");
  const auto sensor = open(0.0);
  ASSERT_TRUE(sensor->start());
  std::vector<int> indices;
  while (sensor->status().state == device::SensorState::kRunning)
    if (const auto frame = sensor->next(1.0).value()) indices.push_back(frame->index.value);
  EXPECT_EQ(indices, (std::vector{0, 1, 2, 3, 5, 6, 8, 9}));
  EXPECT_EQ(sensor->status().dropped, 2);
  EXPECT_NE(sensor->status().message.find("000007.png"), std::string::npos);
}

TEST_F(ReplayTest, DecodesAheadAndDeliversInOrder) {
  const auto sensor = open(0.0);
  std::vector<int> indices;
  device::CaptureLoop loop(sensor,
                           [&](const Frame& frame) { indices.push_back(frame.index.value); });
  while (loop.status().state != device::SensorState::kEnded) std::this_thread::yield();
  loop.stop();
  EXPECT_EQ(indices, (std::vector{0, 1, 2, 3, 4, 5, 6, 7, 8, 9}));
}

// Otherwise a caller with other background work, such as a recorder, would poll in vain.
TEST_F(ReplayTest, ReportsThatNothingIsLeftToDecode) {
  const auto sensor = open(1.0);
  EXPECT_FALSE(sensor->work_in_background(0.0));
  ASSERT_TRUE(sensor->start());
  for (int i = 0; i < ReplayOptions().ahead; ++i) EXPECT_TRUE(sensor->work_in_background(0.0));
  EXPECT_FALSE(sensor->work_in_background(0.0));
  EXPECT_TRUE(sensor->next(1.0).value());
  EXPECT_TRUE(sensor->work_in_background(0.0));
}

TEST_F(ReplayTest, CanBeRestartedAfterTheEnd) {
  const auto sensor = open(0.0);
  for (int round = 0; round < 2; ++round) {
    ASSERT_TRUE(sensor->start());
    EXPECT_EQ(sensor->next(1.0).value()->index.value, 0);
    while (sensor->status().state == device::SensorState::kRunning) (void)sensor->next(1.0);
    EXPECT_EQ(sensor->status().delivered, 10);
  }
}

TEST_F(ReplayTest, ReportsMissingFiles) {
  EXPECT_FALSE(ReplaySensor::open(folder_ / "nowhere", {}, clock_.clock()));
  const auto bad = ReplaySensor::open(folder_.path(), {.speed = -1.0}, clock_.clock());
  ASSERT_FALSE(bad);
  EXPECT_EQ(bad.error().code, ErrorCode::kBadOption);
}

TEST_F(ReplayTest, ReadsTheCalibrationBesideTheRecordingNotInTheCurrentFolder) {
  const calibration::Calibration calibration = testing::small_calibration();
  io::RecordingWriter writer =
      io::RecordingWriter::create(folder_.path(), "own.json", io::fingerprint(calibration)).value();
  ASSERT_TRUE(writer.append(
      {FrameIndex(0), FrameKind::kVertical, 0.0, cv::Mat(5, 6, CV_8UC1, cv::Scalar(9))}));
  ASSERT_TRUE(writer.write_list());
  ASSERT_TRUE(io::write_calibration(folder_.path() / "own.json", calibration));
  const auto sensor = open(1.0);
  ASSERT_NE(sensor->calibration(), nullptr);
  EXPECT_EQ(io::fingerprint(*sensor->calibration()), io::fingerprint(calibration));
}

}  // namespace
}  // namespace flytri::recording
