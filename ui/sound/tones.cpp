#include "ui/sound/tones.h"

#include <array>
#include <cmath>
#include <numbers>

namespace flytri::ui {
namespace {

constexpr double kTone_s = 0.13;
constexpr double kOverlap_s = 0.02;
constexpr double kAttack_s = 0.008;
constexpr double kLevel = 0.5 * 32767.0;

// A sine with a softer octave above it, which small loudspeakers can play; it fades like a bell.
double tone(double frequency_hz, double time_s) {
  if (time_s < 0.0 || time_s > kTone_s) return 0.0;
  const double phase = 2.0 * std::numbers::pi * frequency_hz * time_s;
  const double rise = std::min(time_s / kAttack_s, 1.0);
  const double fall = 1.0 - time_s / kTone_s;
  return rise * fall * (0.75 * std::sin(phase) + 0.25 * std::sin(2.0 * phase));
}

// A fifth and a fourth apart: pleasant intervals, as they are heard many times a day.
std::array<double, 2> frequencies_hz(Sound sound) {
  if (sound == Sound::kLost) return {587.3, 392.0};
  return {587.3, 784.0};
}

}  // namespace

std::vector<std::int16_t> synthesize(Sound sound) {
  const auto [first_hz, second_hz] = frequencies_hz(sound);
  const double second_s = kTone_s - kOverlap_s;
  const auto count = static_cast<int>((second_s + kTone_s) * kSampleRate_hz);
  std::vector<std::int16_t> samples;
  for (int i = 0; i < count; ++i) {
    const double time_s = static_cast<double>(i) / kSampleRate_hz;
    const double value = tone(first_hz, time_s) + tone(second_hz, time_s - second_s);
    samples.push_back(static_cast<std::int16_t>(std::lround(kLevel * value)));
  }
  return samples;
}

}  // namespace flytri::ui
