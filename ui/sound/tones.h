/// @file  The two sounds of a scan, as samples: it was lost, it goes on.
#pragma once

#include <cstdint>
#include <vector>

namespace flytri::ui {

/// Told apart without looking: two falling tones for kLost, two rising ones for kReturn.
enum class Sound { kLost, kReturn };

inline constexpr int kSampleRate_hz = 44100;

/// A quarter of a second, one channel, begun and ended softly, at half of full scale.
[[nodiscard]] std::vector<std::int16_t> synthesize(Sound sound);

}  // namespace flytri::ui
