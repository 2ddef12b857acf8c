#include "hw/rig/frame_merger.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace flytri::rig {
namespace {

constexpr double kPatience_s = 0.25;

cv::Mat image(int value) { return {2, 2, CV_8UC1, cv::Scalar(value)}; }

sync::FrameLabel dark_at(double time_s) {
  sync::FrameLabel label;
  label.outcome = sync::LabelOutcome::kLabeled;
  label.time_s = time_s;
  return label;
}

sync::FrameLabel flash_of(double time_s, double area) {
  sync::FrameLabel label = dark_at(time_s);
  label.light = device::Light::kFlash;
  label.evidence.is_flash = true;
  label.evidence.area = area;
  return label;
}

class FrameMergerTest : public ::testing::Test {
 protected:
  FrameMergerTest() : merger_({.start_s = 10.0, .flash_s = 0.1, .patience_s = kPatience_s}) {}

  void pattern(double time_s) { merger_.add_pattern(Pattern::kVertical, image(0), time_s, time_s); }
  /// Times since the start of all frames that are ready.
  std::vector<double> taken(double now_s, bool texture_comes = true) {
    std::vector<double> times_s;
    while (const auto frame = merger_.next(now_s, texture_comes)) {
      EXPECT_EQ(frame->index.at(), count_++);
      times_s.push_back(frame->time_s);
    }
    return times_s;
  }

  FrameMerger merger_;
  std::size_t count_ = 0;
};

TEST_F(FrameMergerTest, DeliversPatternsAtOnceIfNoFlashIsPlanned) {
  pattern(10.5);
  pattern(10.75);
  EXPECT_EQ(taken(10.75), (std::vector{0.5, 0.75}));
}

TEST_F(FrameMergerTest, APatternAfterAFlashWaitsForItsImage) {
  merger_.flash_at(10.5);
  pattern(10.25);
  pattern(10.75);
  EXPECT_EQ(taken(10.75), std::vector{0.25});
  merger_.add_texture(image(9), flash_of(10.5, 0.5), 10.8);
  EXPECT_TRUE(taken(10.8).empty());
  // The dark frame shows that no brighter image of the flash follows.
  merger_.add_texture(image(0), dark_at(10.625), 10.85);
  EXPECT_EQ(taken(10.85), (std::vector{0.5, 0.75}));
}

TEST_F(FrameMergerTest, WaitsAtMostThePatienceTimeAndNotForALostCamera) {
  merger_.flash_at(10.5);
  pattern(10.75);
  EXPECT_TRUE(taken(10.75 + kPatience_s).empty());
  EXPECT_EQ(taken(10.76 + kPatience_s), std::vector{0.75});
  pattern(11.25);
  EXPECT_EQ(taken(11.25, false), std::vector{1.25});
}

TEST_F(FrameMergerTest, UsesTheBrightestImageOfAFlash) {
  for (const auto& [value, area] : {std::pair{1, 0.2}, {2, 0.5}, {3, 0.51}})
    merger_.add_texture(image(value), flash_of(10.5 + 0.01 * value, area), 10.6);
  merger_.add_texture(image(0), dark_at(10.7), 10.7);
  pattern(10.75);
  const auto texture = merger_.next(10.75, true);
  ASSERT_TRUE(texture);
  EXPECT_EQ(texture->kind, FrameKind::kTexture);
  EXPECT_EQ(texture->image.at<std::uint8_t>(0, 0), 3);
}

// A moving hand changes the brightness by more than a little light of a pattern.
TEST_F(FrameMergerTest, PrefersAnImageThatIsSurelyOfTheFlashAlone) {
  sync::FrameLabel mixture = flash_of(10.52, 0.52);
  mixture.outcome = sync::LabelOutcome::kStraddled;
  merger_.add_texture(image(1), flash_of(10.51, 0.5), 10.6);
  merger_.add_texture(image(2), mixture, 10.6);
  merger_.add_texture(image(0), dark_at(10.7), 10.7);
  pattern(10.75);
  const auto texture = merger_.next(10.75, true);
  ASSERT_TRUE(texture);
  EXPECT_EQ(texture->image.at<std::uint8_t>(0, 0), 1);
}

// The whole image of this flash came too early; the mixture after it must not take its place.
TEST_F(FrameMergerTest, UsesNoImageOfAFlashWhoseWholeOneHasNoTime) {
  sync::FrameLabel whole = flash_of(10.51, 0.5);
  whole.has_time = false;
  merger_.add_texture(image(1), whole, 10.6);
  merger_.add_texture(image(2), flash_of(10.54, 0.3), 10.6);
  merger_.add_texture(image(0), dark_at(10.7), 10.7);
  pattern(10.75);
  EXPECT_EQ(taken(10.75), std::vector{0.75});
}

TEST_F(FrameMergerTest, DropsAndCountsFramesThatArriveAfterALaterOne) {
  merger_.flash_at(10.5);
  pattern(10.75);
  EXPECT_EQ(taken(11.5), std::vector{0.75});
  merger_.add_texture(image(9), flash_of(10.5, 0.5), 11.5);
  merger_.add_texture(image(0), dark_at(10.7), 11.5);
  EXPECT_TRUE(taken(12.0).empty());
  EXPECT_EQ(merger_.late(), 1);
}

}  // namespace
}  // namespace flytri::rig
