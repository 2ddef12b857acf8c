/// @file  The two sounds of a scan, as samples: tracking was lost, tracking returned.
#pragma once

#include <cstdint>
#include <vector>

namespace flytri::ui {

/// kLost: two falling tones. kReturn: two rising tones.
enum class Sound { kLost, kReturn };

inline constexpr int kSampleRate_hz = 44100;

/// A quarter of a second, one channel, with soft start and end, at half of full scale.
[[nodiscard]] std::vector<std::int16_t> synthesize(Sound sound);

}  // namespace flytri::ui
