/// @file  The clock that sources of frames run on, so that tests can turn it by hand.
#pragma once

#include <functional>

namespace flytri::device {

/// Seconds that never run backwards, from an arbitrary zero, and a way to wait for them. Both
/// functions may be called from any thread.
struct Clock {
  std::function<double()> now_s;
  std::function<void(double duration_s)> sleep_s;  ///< returns at once for 0 and less
};

/// The machine's own clock.
[[nodiscard]] Clock machine_clock();

}  // namespace flytri::device
