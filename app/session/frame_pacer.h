/// @file  Keeps drawing from taking the processor away from scanning.
#pragma once

#include <algorithm>
#include <chrono>
#include <thread>

namespace flytri::session {

/// Waits until the next frame of the window is due: a sixtieth of a second after the last one
/// began, so that a new view is soon seen, and not before drawing has rested for a part of the time
/// that it took. Where there is no graphics card, drawing is work for the same processor as
/// scanning.
/// @param frame_s  what the last frame took
inline void rest_after_frame(double frame_s) {
  constexpr double kPeriod_s = 1.0 / 60.0, kRestShare = 0.5;
  const double rest_s = std::max(kPeriod_s - frame_s, kRestShare * std::min(frame_s, kPeriod_s));
  std::this_thread::sleep_for(std::chrono::duration<double>(rest_s));
}

}  // namespace flytri::session
