#include "hw/recording/recorder_sensor.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <fstream>
#include <limits>
#include <opencv2/core.hpp>
#include <thread>

#include "core/io/calibrations/calibration_json.h"
#include "hw/device/capture_loop.h"
#include "hw/recording/replay_sensor.h"
#include "tests/support/full_disk.h"
#include "tests/support/manual_clock.h"
#include "tests/support/scripted_sensor.h"
#include "tests/support/small_calibration.h"
#include "tests/support/temporary_folder.h"

namespace flytri::recording {
namespace {

namespace fs = std::filesystem;
using testing::ManualClock;
using testing::ScriptedSensor;

std::deque<ScriptedSensor::Step> frames(int count) {
  std::deque<ScriptedSensor::Step> script;
  for (int i = 0; i < count; ++i)
    script.push_back(ScriptedSensor::frame(i, i / 30.0, static_cast<std::uint8_t>(7 * i)));
  return script;
}

// Reads all frames of a sensor, with background work in between.
std::vector<Frame> run(device::Sensor& sensor, bool work = true) {
  EXPECT_TRUE(sensor.start());
  std::vector<Frame> taken;
  while (sensor.status().state == device::SensorState::kRunning) {
    if (auto frame = sensor.next(1.0).value()) taken.push_back(*std::move(frame));
    if (work) sensor.work_in_background(0.0);
  }
  return taken;
}

void expect_same(const std::vector<Frame>& live, const std::vector<Frame>& again) {
  ASSERT_EQ(live.size(), again.size());
  for (std::size_t i = 0; i < live.size(); ++i) {
    EXPECT_EQ(live[i].index, again[i].index);
    EXPECT_EQ(live[i].kind, again[i].kind);
    EXPECT_EQ(live[i].time_s, again[i].time_s);
    ASSERT_EQ(live[i].image.size(), again[i].image.size());
    ASSERT_EQ(live[i].image.type(), again[i].image.type());
    EXPECT_EQ(cv::norm(live[i].image, again[i].image, cv::NORM_INF), 0.0) << "frame " << i;
  }
}

std::vector<Frame> replay(const fs::path& folder) {
  const auto sensor = ReplaySensor::open(folder, {.speed = 0.0}, ManualClock().clock()).value();
  return run(*sensor);
}

TEST(RecorderSensor, ReplayedFramesAreBitIdenticalToLiveFrames) {
  const TemporaryFolder folder;
  // Noise images in 8 and 16 bit grey, and in color.
  std::deque<ScriptedSensor::Step> script;
  cv::RNG random(1);
  for (int i = 0; i < 6; ++i) {
    const bool color = i == 3;
    cv::Mat image(48, 64, color ? CV_8UC3 : i % 2 == 0 ? CV_8UC1 : CV_16UC1);
    random.fill(image, cv::RNG::UNIFORM, 0, color || i % 2 == 0 ? 256 : 65536);
    const FrameKind kind = color ? FrameKind::kTexture
                                 : std::array{FrameKind::kVertical, FrameKind::kHorizontal,
                                              FrameKind::kUnknown}[i % 3];
    // Times without a short decimal representation.
    script.push_back([=](device::StatusKeeper&) -> Result<std::optional<Frame>> {
      return Frame{FrameIndex(i), kind, i / 30.0 + 1.0 / 7.0, image};
    });
  }
  const auto recorder =
      RecorderSensor::create(std::make_shared<ScriptedSensor>(script), folder / "scan").value();
  const std::vector<Frame> live = run(*recorder);
  recorder->stop();
  EXPECT_EQ(recorder->recorder_status().written, 6);
  EXPECT_EQ(recorder->recorder_status().lost, 0);
  expect_same(live, replay(folder / "scan"));
}

TEST(RecorderSensor, WritesInTheBackgroundOfTheCaptureLoop) {
  const TemporaryFolder folder;
  const auto recorder =
      RecorderSensor::create(std::make_shared<ScriptedSensor>(frames(50)), folder / "scan").value();
  std::vector<Frame> live;
  {
    device::CaptureLoop loop(recorder, [&](Frame frame) { live.push_back(std::move(frame)); });
    while (loop.status().state != device::SensorState::kEnded) std::this_thread::yield();
  }
  EXPECT_EQ(live.size(), 50U);
  EXPECT_EQ(recorder->recorder_status().written, 50);
  expect_same(live, replay(folder / "scan"));
}

TEST(RecorderSensor, AFullQueueLosesRecordedFramesButNoLiveFrames) {
  const TemporaryFolder folder;
  const auto recorder = RecorderSensor::create(std::make_shared<ScriptedSensor>(frames(10)),
                                               folder / "scan", {.queue_frames = 4})
                            .value();
  EXPECT_EQ(run(*recorder, false).size(), 10U);
  EXPECT_EQ(recorder->recorder_status().waiting, 4);
  recorder->stop();
  EXPECT_EQ(recorder->recorder_status().written, 4);
  EXPECT_EQ(recorder->recorder_status().lost, 6);
  EXPECT_NE(recorder->status().message.find("6 frames are missing"), std::string::npos);
  EXPECT_EQ(replay(folder / "scan").size(), 4U);
}

TEST(RecorderSensor, TheScanContinuesIfTheFolderCannotBeCreated) {
  const TemporaryFolder folder;
  ASSERT_TRUE(std::ofstream(folder / "file") << "in the way");
  const auto recorder =
      RecorderSensor::create(std::make_shared<ScriptedSensor>(frames(5)), folder / "file" / "scan")
          .value();
  EXPECT_EQ(run(*recorder).size(), 5U);
  EXPECT_EQ(recorder->recorder_status().lost, 5);
  EXPECT_NE(recorder->status().message.find("scan continues"), std::string::npos);
  recorder->stop();
}

TEST(RecorderSensor, AWriteErrorEndsTheRecordingButNotTheScan) {
  const TemporaryFolder folder;
  const auto recorder =
      RecorderSensor::create(std::make_shared<ScriptedSensor>(frames(8)), folder / "scan").value();
  ASSERT_TRUE(recorder->start());
  for (int i = 0; i < 8; ++i) {
    EXPECT_TRUE(recorder->next(1.0).value());
    if (i == 3) fs::remove_all(folder / "scan" / "frames");
    recorder->work_in_background(0.0);
  }
  // The images were deleted with the folder, and no list was written yet.
  EXPECT_EQ(recorder->recorder_status().written, 0);
  EXPECT_EQ(recorder->recorder_status().lost, 8);
  EXPECT_NE(recorder->status().message.find("stopped after 0 frames"), std::string::npos);
  recorder->stop();
}

TEST(RecorderSensor, AfterAFullDiskTheWrittenFramesStayAndAreCounted) {
  const TemporaryFolder folder;
  std::deque<ScriptedSensor::Step> script = frames(5);
  cv::Mat noise(256, 256, CV_8UC1);
  cv::RNG(1).fill(noise, cv::RNG::UNIFORM, 0, 256);
  script[3] = [=](device::StatusKeeper&) -> Result<std::optional<Frame>> {
    return Frame{FrameIndex(3), FrameKind::kHorizontal, 3 / 30.0, noise};
  };
  const auto recorder =
      RecorderSensor::create(std::make_shared<ScriptedSensor>(script), folder / "scan").value();
  {
    const FullDisk disk(16'384);
    EXPECT_EQ(run(*recorder).size(), 5U);
  }
  EXPECT_TRUE(recorder->recorder_status().has_ended);
  EXPECT_EQ(recorder->recorder_status().written, 3);
  EXPECT_EQ(recorder->recorder_status().lost, 2);
  EXPECT_NE(recorder->status().message.find("stopped after 3 frames"), std::string::npos);
  recorder->stop();
  EXPECT_EQ(replay(folder / "scan").size(), 3U);
}

TEST(RecorderSensor, StartOfALostSensorDoesNotChangeTheRecording) {
  const TemporaryFolder folder;
  std::deque<ScriptedSensor::Step> script = frames(2);
  script.push_back(ScriptedSensor::nothing(device::SensorState::kLost));
  const auto recorder =
      RecorderSensor::create(std::make_shared<ScriptedSensor>(script), folder / "scan").value();
  run(*recorder);
  ASSERT_EQ(recorder->status().state, device::SensorState::kLost);
  EXPECT_TRUE(recorder->start());
  EXPECT_EQ(recorder->recorder_status().written, 2);
  recorder->stop();
  EXPECT_EQ(replay(folder / "scan").size(), 2U);
}

TEST(RecorderSensor, ACrashLosesOnlyTheLastSeconds) {
  const TemporaryFolder folder;
  {
    const auto recorder = RecorderSensor::create(std::make_shared<ScriptedSensor>(frames(100)),
                                                 folder / "scan", {.list_period_s = 1.0})
                              .value();
    run(*recorder);
    // No stop(), as if the process had crashed here.
  }
  EXPECT_EQ(replay(folder / "scan").size(), 91U);
}

// Records in its own process and sends the number of each written frame through the pipe.
[[noreturn]] void record_and_report(const fs::path& folder, int pipe) {
  const auto recorder =
      RecorderSensor::create(std::make_shared<ScriptedSensor>(frames(100'000)), folder).value();
  if (!recorder->start()) _exit(1);
  for (int number = 0;; ++number) {
    if (!recorder->next(1.0).value()) _exit(1);
    recorder->work_in_background(0.0);
    if (write(pipe, &number, sizeof number) != sizeof number) _exit(1);
  }
}

TEST(RecorderSensor, AKilledProcessLosesOnlyTheLastSecond) {
  for (const int last : {40, 111, 256}) {
    const TemporaryFolder folder;
    std::array<int, 2> pipe{};
    ASSERT_EQ(::pipe(pipe.data()), 0);
    const pid_t child = fork();
    if (child == 0) record_and_report(folder / "scan", pipe[1]);
    int number = -1;
    while (number < last) ASSERT_EQ(read(pipe[0], &number, sizeof number), ssize_t{sizeof number});
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    close(pipe[0]);
    close(pipe[1]);
    // Each listed image is complete, and at most the last second (30 frames) is missing.
    const std::vector<Frame> kept = replay(folder / "scan");
    EXPECT_GE(static_cast<int>(kept.size()), last + 1 - 30);
    EXPECT_EQ(kept.size(), io::open_recording(folder / "scan")->frames.size());
  }
}

// A sensor that cannot be started or that delivers no frames.
TEST(RecorderSensor, WithoutAFrameTheFolderStaysUnchanged) {
  class Absent final : public ScriptedSensor {
   public:
    Absent() : ScriptedSensor({}) {}
    Result<void> start() override { return fail(ErrorCode::kNotFound, "no such camera"); }
  };
  const TemporaryFolder folder;
  const auto absent =
      RecorderSensor::create(std::make_shared<Absent>(), folder / "deep" / "scan").value();
  EXPECT_FALSE(absent->start());
  EXPECT_FALSE(fs::exists(folder / "deep"));
  const auto recorder =
      RecorderSensor::create(std::make_shared<ScriptedSensor>(frames(3)), folder / "scan").value();
  run(*recorder);
  recorder->stop();
  const auto silent =
      RecorderSensor::create(std::make_shared<ScriptedSensor>(frames(0)), folder / "scan").value();
  run(*silent);
  silent->stop();
  // The existing recording is not overwritten.
  EXPECT_EQ(replay(folder / "scan").size(), 3U);
}

TEST(RecorderSensor, NamesTheCalibrationByItsFingerprint) {
  class Calibrated final : public ScriptedSensor {
   public:
    Calibrated() : ScriptedSensor(frames(2)) {}
    std::shared_ptr<const calibration::Calibration> calibration() const override {
      return std::make_shared<const calibration::Calibration>(testing::small_calibration());
    }
  };
  const TemporaryFolder folder;
  const auto recorder =
      RecorderSensor::create(std::make_shared<Calibrated>(), folder / "scan").value();
  run(*recorder);
  recorder->stop();
  EXPECT_EQ(io::open_recording(folder / "scan")->calibration_fingerprint,
            io::fingerprint(testing::small_calibration()));
  // The recording opens wherever it is moved to.
  fs::rename(folder / "scan", folder / "moved");
  const auto moved = ReplaySensor::open(folder / "moved", {.speed = 0.0}, ManualClock().clock());
  ASSERT_TRUE(moved) << moved.error().message;
  EXPECT_NE((*moved)->calibration(), nullptr);
}

/// A recorder without a folder, and a scripted sensor of many frames.
std::shared_ptr<RecorderSensor> switched_recorder(const RecorderOptions& options = {}) {
  const auto sensor = std::make_shared<ScriptedSensor>(frames(30));
  return RecorderSensor::create(sensor, options).value();
}

/// Takes frames, and lets the background work.
void take(RecorderSensor& recorder, int count) {
  for (int i = 0; i < count; ++i) {
    ASSERT_TRUE(recorder.next(1.0).value());
    while (recorder.work_in_background(0.0)) {
    }
  }
}

TEST(RecorderSensor, RecordsOnlyWhatComesBetweenOnAndOff) {
  const TemporaryFolder folder;
  const auto recorder = switched_recorder();
  ASSERT_TRUE(recorder->start());
  take(*recorder, 3);
  EXPECT_FALSE(recorder->recorder_status().is_recording);
  EXPECT_EQ(recorder->recorder_status().lost, 0);
  recorder->record_to(folder.path() / "a");
  while (recorder->work_in_background(0.0)) {
  }
  take(*recorder, 5);
  EXPECT_TRUE(recorder->recorder_status().is_recording);
  EXPECT_EQ(recorder->recorder_status().written, 5);
  EXPECT_GT(recorder->recorder_status().bytes, 0U);
  recorder->end_recording();
  while (recorder->work_in_background(0.0)) {
  }
  take(*recorder, 2);
  EXPECT_FALSE(recorder->recorder_status().is_recording);
  recorder->record_to(folder.path() / "b");
  while (recorder->work_in_background(0.0)) {
  }
  take(*recorder, 4);
  recorder->stop();
  EXPECT_EQ(replay(folder.path() / "a").size(), 5U);
  EXPECT_EQ(replay(folder.path() / "b").size(), 4U);
  EXPECT_EQ(recorder->recorder_status().message, "");
}

TEST(RecorderSensor, NobodyElseCanReadAPrivateRecording) {
  const TemporaryFolder folder;
  const auto recorder = switched_recorder({.is_private = true});
  recorder->record_to(folder.path() / "a");
  ASSERT_TRUE(recorder->start());
  while (recorder->work_in_background(0.0)) {
  }
  take(*recorder, 2);
  recorder->stop();
  int files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder.path() / "a")) {
    const fs::perms others = fs::perms::group_all | fs::perms::others_all;
    EXPECT_EQ(entry.status().permissions() & others, fs::perms::none) << entry.path();
    files += entry.is_regular_file() ? 1 : 0;
  }
  EXPECT_GE(files, 3) << "two images and the list";
  EXPECT_EQ(fs::status(folder.path() / "a").permissions() & fs::perms::all, fs::perms::owner_all);
}

TEST(RecorderSensor, LeavesRoomOnTheDisk) {
  const TemporaryFolder folder;
  RecorderOptions options;
  options.least_free_bytes = std::numeric_limits<std::uintmax_t>::max() / 2;
  const auto recorder = switched_recorder(options);
  recorder->record_to(folder.path() / "a");
  ASSERT_TRUE(recorder->start());
  while (recorder->work_in_background(0.0)) {
  }
  take(*recorder, 3);
  const RecorderStatus status = recorder->recorder_status();
  EXPECT_TRUE(status.has_ended);
  EXPECT_NE(status.message.find("which the scan needs"), std::string::npos) << status.message;
  EXPECT_EQ(recorder->status().state, device::SensorState::kRunning) << "the scan goes on";
  recorder->stop();
}

}  // namespace
}  // namespace flytri::recording
