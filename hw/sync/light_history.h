/// @file  Computes which light was on for how long, from the requests to the light switch.
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

/// Duration of each light within a time interval, in seconds.
struct LightTimes {
  std::array<double, kLightCount> lit_s = {};  ///< by Light
  double changing_s = 0.0;  ///< light unknown: a call to the device was in progress
  [[nodiscard]] double lit(device::Light light) const { return lit_s[at(light)]; }
};

/// Starts dark. The light is unknown while a device call is in progress, and from the time that a
/// request is due until it is reported as done. A refused request changes nothing.
class LightHistory {
 public:
  /// Adds a posted request with its number.
  void posted(std::int64_t request, double not_before_s);
  /// A request was carried out; this also completes all requests before it.
  void switched(const device::LightSwitching& done);

  /// Running mean of the duration of device calls; 0 before the first call.
  [[nodiscard]] double call_s() const { return call_s_; }
  /// Which light was on from `from_s` to `to_s`, as far as known.
  [[nodiscard]] LightTimes times(double from_s, double to_s) const;
  /// Running sums of times() over `count` steps from `start_s` on; count + 1 entries.
  [[nodiscard]] std::vector<LightTimes> running_times(double start_s, double step_s,
                                                      int count) const;

 private:
  /// Begin of an interval and its state: a Light, or kLightCount while it is unknown.
  struct Stretch {
    double begin_s = 0.0;
    std::size_t state = 0;
  };
  struct Pending {
    std::int64_t request = 0;
    double not_before_s = 0.0;
  };

  double call_s_ = 0.0;
  std::deque<Stretch> stretches_;  // by increasing time
  std::deque<Pending> pending_;    // by increasing number
};

}  // namespace flytri::sync
