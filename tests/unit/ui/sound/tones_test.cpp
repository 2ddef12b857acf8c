#include "ui/sound/tones.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "ui/sound/sound_player.h"

namespace flytri::ui {
namespace {

// Rising zero crossings a second in a part of the samples.
double pitch_hz(const std::vector<std::int16_t>& samples, double begin_s, double end_s) {
  int crossings = 0;
  const int begin = static_cast<int>(begin_s * kSampleRate_hz);
  const int end = static_cast<int>(end_s * kSampleRate_hz);
  for (int i = begin + 1; i < end; ++i)
    if (samples[i - 1] < 0 && samples[i] >= 0) ++crossings;
  return crossings / (end_s - begin_s);
}

TEST(Tones, LossHasFallingAndReturnRisingTones) {
  const auto lost = synthesize(Sound::kLost);
  const auto found = synthesize(Sound::kReturn);
  EXPECT_GT(pitch_hz(lost, 0.01, 0.1), 1.3 * pitch_hz(lost, 0.14, 0.23));
  EXPECT_LT(1.2 * pitch_hz(found, 0.01, 0.1), pitch_hz(found, 0.14, 0.23));
}

TEST(Tones, StartAndEndSoftlyAndNeverClip) {
  for (const Sound sound : {Sound::kLost, Sound::kReturn}) {
    const auto samples = synthesize(sound);
    EXPECT_NEAR(static_cast<double>(samples.size()) / kSampleRate_hz, 0.25, 0.02);
    // A jump of a hundredth of full scale would be heard as a click.
    EXPECT_LT(std::abs(samples.front()), 300);
    EXPECT_LT(std::abs(samples.back()), 300);
    const auto loudest = std::max_element(samples.begin(), samples.end());
    EXPECT_GT(*loudest, 8000);
    EXPECT_LT(*loudest, 20000);
  }
}

TEST(SoundPlayer, DoesNothingWithoutADeviceAndNeverPrints) {
  ::testing::internal::CaptureStderr();
  SoundPlayer player;
  player.play(Sound::kLost);
  player.set_muted(true);
  player.play(Sound::kReturn);
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace flytri::ui
