#include "hw/device/threaded_camera.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <deque>
#include <mutex>
#include <thread>

namespace flytri::device {
namespace {

constexpr double kLong_s = 60.0;

/// Returns the next scripted result at each call of next(); after the last one, no frames.
class ScriptedCamera final : public Camera {
 public:
  struct Line {
    Result<std::optional<CameraFrame>> frame = std::optional<CameraFrame>();
    CameraState state = CameraState::kRunning;
    std::int64_t returned = 0;
  };

  Result<void> start() override {
    const std::lock_guard lock(mutex_);
    status_ = {};
    status_.state = start_error ? CameraState::kFailed : CameraState::kRunning;
    if (start_error) return tl::unexpected(*start_error);
    return {};
  }
  void stop() override {
    const std::lock_guard lock(mutex_);
    status_.state = CameraState::kIdle;
  }
  Result<std::optional<CameraFrame>> next(double timeout_s) override {
    // Simulates a restart that takes as long as the test wants.
    while (is_setting_up) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    std::unique_lock lock(mutex_);
    if (status_.state == CameraState::kIdle)
      return fail(ErrorCode::kBadOption, "the camera was not started");
    if (lines_.empty()) {
      lock.unlock();
      std::this_thread::sleep_for(std::chrono::duration<double>(std::min(timeout_s, 0.001)));
      return std::nullopt;
    }
    Line line = std::move(lines_.front());
    lines_.pop_front();
    status_.state = line.state;
    status_.returned = line.returned;
    if (line.frame && *line.frame) ++status_.delivered;
    return std::move(line.frame);
  }
  CameraStatus status() const override {
    const std::lock_guard lock(mutex_);
    return status_;
  }
  CameraSettings requested() const override { return {}; }
  CameraSettings read_back() const override { return {}; }
  std::string name() const override { return "scripted"; }

  void say(Line line) {
    const std::lock_guard lock(mutex_);
    lines_.push_back(std::move(line));
  }
  void say_frame(std::int64_t sequence, std::int64_t returned = 0) {
    CameraFrame frame;
    frame.sequence = sequence;
    say({std::optional(frame), CameraState::kRunning, returned});
  }
  std::size_t remaining() const {
    const std::lock_guard lock(mutex_);
    return lines_.size();
  }

  std::optional<Error> start_error;
  std::atomic<bool> is_setting_up = false;

 private:
  mutable std::mutex mutex_;
  std::deque<Line> lines_;
  CameraStatus status_;
};

class ThreadedCameraTest : public ::testing::Test {
 protected:
  ThreadedCameraTest() {
    auto scripted = std::make_unique<ScriptedCamera>();
    scripted_ = scripted.get();
    camera_ = std::make_unique<ThreadedCamera>(std::move(scripted));
  }

  std::unique_ptr<ThreadedCamera> camera_;
  ScriptedCamera* scripted_ = nullptr;
};

TEST_F(ThreadedCameraTest, LosesNoFrameWhenTheReaderIsSlow) {
  constexpr std::int64_t kFrames = 30;
  for (std::int64_t i = 0; i < kFrames; ++i) scripted_->say_frame(i);
  ASSERT_TRUE(camera_->start());
  // Except for a short queue, frames that are not fetched stay in the driver.
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_GT(scripted_->remaining(), 15U);
  for (std::int64_t i = 0; i < kFrames; ++i) {
    const auto frame = camera_->next(kLong_s);
    ASSERT_TRUE(frame && *frame);
    EXPECT_EQ((*frame)->sequence, i);
    EXPECT_EQ(camera_->status().delivered, i + 1);
  }
  EXPECT_FALSE(*camera_->next(0.0));
}

TEST_F(ThreadedCameraTest, ARestartOfTheCameraDoesNotBlockTheReader) {
  scripted_->is_setting_up = true;
  ASSERT_TRUE(camera_->start());
  for (int i = 0; i < 100; ++i) {
    const auto frame = camera_->next(0.0);
    ASSERT_TRUE(frame);
    EXPECT_FALSE(*frame);
  }
  scripted_->say_frame(7);
  scripted_->is_setting_up = false;
  EXPECT_EQ((**camera_->next(kLong_s)).sequence, 7);
}

TEST_F(ThreadedCameraTest, StatusBelongsToTheFrameReturnedLast) {
  scripted_->say_frame(0);
  scripted_->say({std::optional<CameraFrame>(), CameraState::kLost});
  scripted_->say_frame(4, 1);
  ASSERT_TRUE(camera_->start());
  while (scripted_->remaining() > 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  EXPECT_EQ((**camera_->next(kLong_s)).sequence, 0);
  EXPECT_EQ(camera_->status().returned, 0);
  EXPECT_EQ(camera_->status().state, CameraState::kRunning);
  EXPECT_FALSE(*camera_->next(kLong_s));
  EXPECT_EQ(camera_->status().state, CameraState::kLost);
  EXPECT_EQ((**camera_->next(kLong_s)).sequence, 4);
  EXPECT_EQ(camera_->status().returned, 1);
}

TEST_F(ThreadedCameraTest, AnErrorComesInOrderAndStays) {
  scripted_->say_frame(0);
  scripted_->say({tl::unexpected(Error{ErrorCode::kNotFound, "gone"})});
  ASSERT_TRUE(camera_->start());
  EXPECT_TRUE(*camera_->next(kLong_s));
  EXPECT_EQ(camera_->next(kLong_s).error().message, "gone");
  EXPECT_EQ(camera_->next(0.0).error().message, "gone");
}

TEST_F(ThreadedCameraTest, ReportsAFailedStartAndStartsAgainAfterStop) {
  EXPECT_EQ(camera_->next(0.0).error().message, "the camera was not started");
  scripted_->start_error = Error{ErrorCode::kNotFound, "no such camera"};
  EXPECT_EQ(camera_->start().error().message, "no such camera");
  EXPECT_EQ(camera_->status().state, CameraState::kFailed);
  scripted_->start_error.reset();
  ASSERT_TRUE(camera_->start());
  scripted_->say_frame(0);
  EXPECT_TRUE(*camera_->next(kLong_s));
  camera_->stop();
  EXPECT_EQ(camera_->status().state, CameraState::kIdle);
  ASSERT_TRUE(camera_->start());
  scripted_->say_frame(0);
  EXPECT_TRUE(*camera_->next(kLong_s));
  EXPECT_EQ(camera_->status().delivered, 1);
}

}  // namespace
}  // namespace flytri::device
