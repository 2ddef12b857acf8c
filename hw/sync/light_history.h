/// @file  From what was asked of the light switch to which light shone for how long.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <vector>

#include "hw/device/light_switch.h"

namespace flytri::sync {

inline constexpr std::size_t kLightCount = 4;

[[nodiscard]] constexpr std::size_t at(device::Light light) {
  return static_cast<std::size_t>(light);
}

/// How a stretch of time is shared out, in seconds.
struct LightTimes {
  std::array<double, kLightCount> lit_s = {};  ///< by Light
  double changing_s = 0.0;                     ///< a call to the device was in progress
  [[nodiscard]] double lit(device::Light light) const { return lit_s[at(light)]; }
};

/// Dark at first. While a call to the device is in progress it is not known what shines; nor is it
/// from when a request was due until it is reported as done. A refused request changes nothing.
class LightHistory {
 public:
  /// A request was posted under this number.
  void posted(std::int64_t request, double not_before_s);
  /// It was done, and with it all requests before it.
  void switched(const device::LightSwitching& done);

  /// How long calls to the device take of late: a running mean, 0 before the first.
  [[nodiscard]] double call_s() const { return call_s_; }
  /// What shone from `from_s` to `to_s`, as far as is known by now.
  [[nodiscard]] LightTimes times(double from_s, double to_s) const;
  /// Running sums of times() over `count` steps from `start_s` on; count + 1 entries.
  [[nodiscard]] std::vector<LightTimes> running_times(double start_s, double step_s,
                                                      int count) const;

 private:
  /// From `begin_s` on; no light: it is changing.
  struct Stretch {
    double begin_s = 0.0;
    std::size_t state = 0;
  };
  struct Pending {
    std::int64_t request = 0;
    double not_before_s = 0.0;
  };

  double call_s_ = 0.0;
  std::deque<Stretch> stretches_;  // by rising time
  std::deque<Pending> pending_;    // by rising number
};

}  // namespace flytri::sync
