/// @file  Interface of the light switch: takes requests and reports when each was carried out.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace flytri::device {

/// Which light is on. Only one at a time, so that the patterns do not mix.
enum class Light { kDark, kVertical, kHorizontal, kFlash };

[[nodiscard]] std::string_view to_string(Light light);

/// A request to turn on a light at a given time.
struct LightRequest {
  Light light = Light::kDark;
  double not_before_s = 0.0;  ///< on machine_clock(); at once if in the past
};

/// When a request was carried out. If the light changed, it changed after `before_s` and shortly
/// after `after_s`; the exact delay can only be learned from the images.
struct LightSwitching {
  std::int64_t request = 0;    ///< the number that post() returned
  Light light = Light::kDark;  ///< kDark, too, if a limit forbade the requested light
  double before_s = 0.0;       ///< when the call to the device began
  double after_s = 0.0;        ///< when it returned
  /// The device reported success. True does not prove that the light changed. False: the command
  /// did not reach the device.
  bool accepted = false;
};

/// kLost: the device is unplugged. The switch searches for it and repeats the latest request when
/// it is back.
enum class LightSwitchState { kIdle, kRunning, kLost, kFailed };

[[nodiscard]] std::string_view to_string(LightSwitchState state);

/// start() resets the counts.
struct LightSwitchStatus {
  LightSwitchState state = LightSwitchState::kIdle;
  std::string message;        ///< what is wrong and what to do; empty if nothing is wrong
  std::int64_t switched = 0;  ///< accepted by the device
  std::int64_t refused = 0;   ///< not accepted by the device
  std::int64_t skipped = 0;   ///< replaced by a later request that was already due
  std::int64_t limited = 0;   ///< turned off, or left off, by a limit or before a suspend
  std::int64_t lost = 0;      ///< how often the device was unplugged
  std::int64_t returned = 0;  ///< how often it was found again
  double slowest_s = 0.0;     ///< longest call to the device so far, including one in progress
};

/// Call start and stop from one thread at a time. All other members are thread-safe and never wait
/// for the device. All lights are dark after stop() and after destruction, provided that the device
/// still answers. Each light keeps its limits (light_limits.h): at a limit it is turned off, and
/// can be turned on again after a rest.
class LightSwitch {
 public:
  virtual ~LightSwitch() = default;
  LightSwitch(const LightSwitch&) = delete;
  LightSwitch& operator=(const LightSwitch&) = delete;

  /// Finds the device and turns all lights off. Does nothing if it already runs.
  /// @errors  kNotFound, kNotPermitted, kInconsistent (another program uses a line). On an error,
  ///          the state is kFailed and the status has the error's message.
  [[nodiscard]] virtual Result<void> start() = 0;

  /// Turns all lights off and releases the device. Waits for a call to the device in progress.
  virtual void stop() = 0;

  /// Requests a light. Requests are carried out in the order of posting; if several are due, only
  /// the last one of them.
  /// @return  the number of the request, from 1 since start(); 0 if the switch does not run
  virtual std::int64_t post(const LightRequest& request) = 0;

  /// The requests carried out since the last call, in order; at most the latest thousand. When a
  /// lost device is found again, its latest request is carried out again under the same number. A
  /// light that a limit turned off is reported as kDark under the number of the latest request.
  [[nodiscard]] virtual std::vector<LightSwitching> take_done() = 0;

  [[nodiscard]] virtual LightSwitchStatus status() const = 0;

 protected:
  LightSwitch() = default;
};

}  // namespace flytri::device
