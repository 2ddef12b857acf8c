/// @file  Limits drawing, so that it leaves enough of the processor for scanning.
#pragma once

#include <algorithm>
#include <chrono>
#include <thread>

namespace flytri::session {

/// Waits until the next frame of the window is due. That is a sixtieth of a second after the last
/// one began, but not before a rest of half the time that the last one took: without a graphics
/// card, drawing and scanning share the processor.
/// @param frame_s  duration of the last frame
inline void rest_after_frame(double frame_s) {
  constexpr double kPeriod_s = 1.0 / 60.0, kRestShare = 0.5;
  const double rest_s = std::max(kPeriod_s - frame_s, kRestShare * std::min(frame_s, kPeriod_s));
  std::this_thread::sleep_for(std::chrono::duration<double>(rest_s));
}

}  // namespace flytri::session
