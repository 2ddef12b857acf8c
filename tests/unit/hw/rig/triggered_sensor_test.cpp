#include "hw/rig/triggered_sensor.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <deque>
#include <thread>

#include "tests/support/sequencer_board.h"

namespace flytri::rig {
namespace {

using ::testing::HasSubstr;
using testing::SequencerBoard;

/// The gray value of an image of a light: that of its output on the board.
std::uint8_t gray_of(int output) { return static_cast<std::uint8_t>(50 * (output + 1)); }

/// A camera on a trigger of the board. Its images show which light was on, and arrive later.
class CameraOnTheBoard final : public device::Camera {
 public:
  CameraOnTheBoard(const SequencerBoard& board, int trigger, double exposure_s)
      : board_(board), pin_(SequencerBoard::kFirstTrigger + trigger) {
    settings_.rate_hz = 40.0;
    settings_.exposure_s = exposure_s;
    settings_.trigger = "Line1";
  }

  Result<void> start() override {
    seen_ = board_.changes().size();
    return {};
  }
  void stop() override {}
  Result<std::optional<device::CameraFrame>> next(double timeout_s) override {
    for (const double end_s = clock_.now_s() + timeout_s;;) {
      look();
      if (!coming_.empty() && clock_.now_s() >= coming_.front().time_s + kTransfer_s) {
        const device::CameraFrame frame = coming_.front();
        coming_.pop_front();
        return frame;
      }
      if (clock_.now_s() >= end_s) return std::nullopt;
      std::this_thread::sleep_for(std::chrono::microseconds(300));
    }
  }
  device::CameraStatus status() const override {
    device::CameraStatus status;
    status.state = device::CameraState::kRunning;
    return status;
  }
  device::CameraSettings requested() const override { return settings_; }
  device::CameraSettings read_back() const override { return settings_; }
  std::string name() const override { return "camera on the board"; }

  /// The wire of its trigger is off.
  std::atomic<bool> is_unwired = false;
  /// So many of the next exposures have no image.
  std::atomic<int> loses = 0;
  /// So many of the next triggers come too early for it: it takes no image, and counts none.
  std::atomic<int> misses = 0;

 private:
  static constexpr double kReadout_s = 0.009;
  /// Two periods: the images of two triggers are on their way.
  static constexpr double kTransfer_s = 0.06;

  void look() {
    const auto changes = board_.changes();
    for (; seen_ < changes.size(); ++seen_) {
      const auto& change = changes[seen_];
      if (change.pin < SequencerBoard::kFirstTrigger) {
        if (change.is_high) lit_ = change.pin;
        continue;
      }
      if (change.pin != pin_ || !change.is_high || is_unwired) continue;
      if (misses > 0) {
        --misses;
        continue;
      }
      device::CameraFrame frame;
      frame.image = cv::Mat(2, 2, CV_8UC1, cv::Scalar(gray_of(lit_)));
      frame.time_s = change.time_s + kReadout_s;
      frame.sequence = sequence_++;
      if (loses > 0) {
        --loses;
        continue;
      }
      coming_.push_back(frame);
    }
  }

  const SequencerBoard& board_;
  const int pin_;
  const device::Clock clock_ = device::machine_clock();
  device::CameraSettings settings_;
  std::size_t seen_ = 0;
  int lit_ = 0;
  std::int64_t sequence_ = 1000;
  std::deque<device::CameraFrame> coming_;
};

class TriggeredSensorTest : public ::testing::Test {
 protected:
  TriggeredSensorTest() {
    options_.flash_period_s = 0.4;
    options_.limits.flash = {0.5, 0.5};
  }

  std::shared_ptr<TriggeredSensor> make() {
    const std::vector<device::LightLimit> limits = {
        options_.limits.vertical, options_.limits.horizontal, options_.limits.flash};
    return *TriggeredSensor::create(
        {measurement_, texture_,
         [this, limits] { return gpio::Sequencer::open(board_.node(), limits); }, clock_},
        options_, nullptr);
  }
  /// Frames until there are so many, or ten seconds are over.
  std::vector<Frame> take(TriggeredSensor& sensor, std::size_t count) const {
    std::vector<Frame> frames;
    for (const double end_s = clock_.now_s() + 10.0;
         frames.size() < count && clock_.now_s() < end_s;) {
      auto frame = sensor.next(0.05);
      EXPECT_TRUE(frame) << frame.error().message;
      if (!frame) break;
      if (*frame) frames.push_back(**frame);
    }
    return frames;
  }
  static std::size_t wrong_labels(const std::vector<Frame>& frames) {
    return static_cast<std::size_t>(
        std::count_if(frames.begin(), frames.end(), [](const Frame& frame) {
          const int output = frame.kind == FrameKind::kVertical     ? 0
                             : frame.kind == FrameKind::kHorizontal ? 1
                                                                    : 2;
          return frame.image.at<std::uint8_t>(0, 0) != gray_of(output);
        }));
  }
  static std::size_t count(const std::vector<Frame>& frames, FrameKind kind) {
    return static_cast<std::size_t>(std::count_if(
        frames.begin(), frames.end(), [&](const Frame& frame) { return frame.kind == kind; }));
  }

  SequencerBoard board_;
  const device::Clock clock_ = device::machine_clock();
  std::shared_ptr<CameraOnTheBoard> measurement_ =
      std::make_shared<CameraOnTheBoard>(board_, 0, 0.006);
  std::shared_ptr<CameraOnTheBoard> texture_ = std::make_shared<CameraOnTheBoard>(board_, 1, 0.01);
  TriggeredSensorOptions options_;
};

TEST_F(TriggeredSensorTest, EachImageHasTheLightOfItsExposure) {
  const auto sensor = make();
  ASSERT_TRUE(sensor->start());
  const std::vector<Frame> frames = take(*sensor, 60);
  sensor->stop();
  ASSERT_EQ(frames.size(), 60U);
  EXPECT_EQ(wrong_labels(frames), 0U);
  EXPECT_GE(count(frames, FrameKind::kTexture), 2U);
  EXPECT_NEAR(static_cast<double>(count(frames, FrameKind::kVertical)),
              static_cast<double>(count(frames, FrameKind::kHorizontal)), 2.0);
  for (std::size_t i = 1; i < frames.size(); ++i) EXPECT_GT(frames[i].time_s, frames[i - 1].time_s);
  EXPECT_TRUE(board_.is_dark());
  const RigStatus status = sensor->rig_status();
  EXPECT_TRUE(status.keeps_step);
  EXPECT_EQ(status.measurement.labels.straddled, 0);
}

TEST_F(TriggeredSensorTest, TimesAreThoseOfTheTriggers) {
  texture_.reset();
  const auto sensor = make();
  ASSERT_TRUE(sensor->start());
  const std::vector<Frame> frames = take(*sensor, 20);
  sensor->stop();
  ASSERT_EQ(frames.size(), 20U);
  std::vector<double> rises_s;
  for (const auto& change : board_.changes())
    if (change.pin == SequencerBoard::kFirstTrigger && change.is_high)
      rises_s.push_back(change.time_s);
  // The first triggers had images that only showed the delay.
  const double first_s = frames.front().time_s;
  for (const Frame& frame : frames) {
    double nearest_s = 1.0;
    for (const double rise_s : rises_s)
      nearest_s = std::min(nearest_s, std::abs(frame.time_s - first_s - (rise_s - rises_s[3])));
    EXPECT_LT(nearest_s, 0.003);
  }
}

TEST_F(TriggeredSensorTest, ALostImageCostsOnlyItself) {
  const auto sensor = make();
  ASSERT_TRUE(sensor->start());
  std::vector<Frame> frames = take(*sensor, 20);
  measurement_->loses = 3;
  const std::vector<Frame> more = take(*sensor, 30);
  frames.insert(frames.end(), more.begin(), more.end());
  EXPECT_EQ(frames.size(), 50U);
  EXPECT_EQ(wrong_labels(frames), 0U);
  EXPECT_EQ(sensor->rig_status().measurement.labels.unknown, 0);
}

/// Its images would all be numbered one too low from then on.
TEST_F(TriggeredSensorTest, ATriggerThatTheCameraMissedIsNoticed) {
  const auto sensor = make();
  ASSERT_TRUE(sensor->start());
  std::vector<Frame> frames = take(*sensor, 15);
  measurement_->misses = 1;
  const std::vector<Frame> more = take(*sensor, 40);
  frames.insert(frames.end(), more.begin(), more.end());
  EXPECT_EQ(frames.size(), 55U);
  EXPECT_EQ(wrong_labels(frames), 0U);
  EXPECT_GT(sensor->rig_status().measurement.labels.unknown, 0);
  EXPECT_TRUE(sensor->rig_status().keeps_step);
}

TEST_F(TriggeredSensorTest, SaysThatATriggerIsNotWiredAndGoesOnOnceItIs) {
  texture_.reset();
  measurement_->is_unwired = true;
  const auto sensor = make();
  ASSERT_TRUE(sensor->start());
  for (const double end_s = clock_.now_s() + 10.0;
       clock_.now_s() < end_s && sensor->status().state != device::SensorState::kLost;)
    ASSERT_TRUE(sensor->next(0.05));
  EXPECT_EQ(sensor->status().state, device::SensorState::kLost);
  EXPECT_THAT(sensor->status().message, HasSubstr("trigger 0"));
  measurement_->is_unwired = false;
  EXPECT_EQ(take(*sensor, 5).size(), 5U);
  EXPECT_EQ(sensor->status().state, device::SensorState::kRunning);
  EXPECT_EQ(sensor->status().message, "");
}

TEST_F(TriggeredSensorTest, NoticesAWireThatComesOffWhileScanning) {
  const auto sensor = make();
  ASSERT_TRUE(sensor->start());
  std::vector<Frame> frames = take(*sensor, 30);
  texture_->is_unwired = true;
  // On a busy machine it may first miss exposures for another reason.
  const auto is_noticed = [&] {
    return sensor->status().message.find("trigger 1") != std::string::npos;
  };
  for (const double end_s = clock_.now_s() + 10.0; clock_.now_s() < end_s && !is_noticed();) {
    const auto frame = sensor->next(0.05);
    ASSERT_TRUE(frame);
    if (*frame) frames.push_back(**frame);
  }
  EXPECT_THAT(sensor->status().message, HasSubstr("trigger 1"));
  EXPECT_EQ(sensor->status().state, device::SensorState::kRunning) << "it goes on without texture";
  measurement_->is_unwired = true;
  for (const double end_s = clock_.now_s() + 10.0;
       clock_.now_s() < end_s && sensor->status().state != device::SensorState::kLost;)
    ASSERT_TRUE(sensor->next(0.05));
  EXPECT_THAT(sensor->status().message, HasSubstr("trigger 0"));
  measurement_->is_unwired = texture_->is_unwired = false;
  const std::vector<Frame> more = take(*sensor, 60);
  EXPECT_EQ(more.size(), 60U);
  EXPECT_GT(count(more, FrameKind::kTexture), 0U);
  frames.insert(frames.end(), more.begin(), more.end());
  EXPECT_EQ(wrong_labels(frames), 0U);
  EXPECT_EQ(sensor->status().message, "");
}

TEST_F(TriggeredSensorTest, ASequencerThatHangsIsDarkAndFoundAgain) {
  const auto sensor = make();
  ASSERT_TRUE(sensor->start());
  std::vector<Frame> frames = take(*sensor, 10);
  board_.mute(true);
  for (const double end_s = clock_.now_s() + 10.0;
       clock_.now_s() < end_s && sensor->status().message.empty();)
    ASSERT_TRUE(sensor->next(0.05));
  EXPECT_NE(sensor->status().message, "");
  EXPECT_TRUE(board_.is_dark());
  board_.mute(false);
  const std::vector<Frame> more = take(*sensor, 20);
  frames.insert(frames.end(), more.begin(), more.end());
  EXPECT_EQ(frames.size(), 30U);
  EXPECT_EQ(wrong_labels(frames), 0U);
}

TEST_F(TriggeredSensorTest, IsDarkWhileItRests) {
  const auto sensor = make();
  ASSERT_TRUE(sensor->start());
  std::vector<Frame> frames = take(*sensor, 10);
  sensor->rest(true);
  ASSERT_TRUE(sensor->next(0.1));
  const std::size_t before = board_.changes().size();
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(sensor->next(0.05));
  EXPECT_EQ(board_.changes().size(), before);
  EXPECT_TRUE(board_.is_dark());
  sensor->rest(false);
  const std::vector<Frame> more = take(*sensor, 15);
  frames.insert(frames.end(), more.begin(), more.end());
  EXPECT_EQ(frames.size(), 25U);
  EXPECT_EQ(wrong_labels(frames), 0U);
}

TEST_F(TriggeredSensorTest, RefusesExposuresThatDoNotFit) {
  measurement_ = std::make_shared<CameraOnTheBoard>(board_, 0, 0.03);
  const auto slow = make();
  const auto refused = slow->start();
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, HasSubstr("do not fit in a period of 25.0 ms"));
  EXPECT_EQ(slow->status().state, device::SensorState::kFailed);

  measurement_ = std::make_shared<CameraOnTheBoard>(board_, 0, 0.006);
  options_.limits.flash = {0.5, 0.02};
  const auto bright = make()->start();
  ASSERT_FALSE(bright);
  EXPECT_THAT(bright.error().message, HasSubstr("max_duty"));
}

}  // namespace
}  // namespace flytri::rig
