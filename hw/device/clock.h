/// @file  The clock of the devices. Tests replace it by one that they control.
#pragma once

#include <functional>

namespace flytri::device {

/// A monotonic time in seconds from an arbitrary zero, and a function to sleep. Both are
/// thread-safe.
struct Clock {
  std::function<double()> now_s;
  std::function<void(double duration_s)> sleep_s;  ///< returns at once for 0 or less
};

/// The monotonic clock of this machine.
[[nodiscard]] Clock machine_clock();

}  // namespace flytri::device
