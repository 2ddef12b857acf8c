/// @file  Turns the lights of the rig on and off: requests go in, the times of what was done come
/// out.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace flytri::device {

/// What is to shine. One light at a time: patterns must not mix.
enum class Light { kDark, kVertical, kHorizontal, kFlash };

[[nodiscard]] std::string_view to_string(Light light);

/// A light that is wanted, and from when on.
struct LightRequest {
  Light light = Light::kDark;
  double not_before_s = 0.0;  ///< on the clock of machine_clock(); past: at once
};

/// What was done for a request. The light changed, if it did, after `before_s`, and not long after
/// `after_s`: how long is for the image to tell.
struct LightSwitching {
  std::int64_t request = 0;  ///< the number that post() gave
  Light light = Light::kDark;
  double before_s = 0.0;  ///< when the call to the device began
  double after_s = 0.0;   ///< when it returned
  /// The device said so. True is no proof that the light changed; false: it certainly was not told.
  bool accepted = false;
};

/// kLost: the device is away; it is looked for, and goes on with the latest request when it is
/// back.
enum class LightSwitchState { kIdle, kRunning, kLost, kFailed };

[[nodiscard]] std::string_view to_string(LightSwitchState state);

/// Counts begin anew at start().
struct LightSwitchStatus {
  LightSwitchState state = LightSwitchState::kIdle;
  std::string message;        ///< what is wrong and its remedy; empty where nothing is
  std::int64_t switched = 0;  ///< accepted by the device
  std::int64_t refused = 0;   ///< not accepted
  std::int64_t skipped = 0;   ///< a later request was due before its turn came
  std::int64_t lost = 0;      ///< times that the device went away
  std::int64_t returned = 0;  ///< times that it was there again
  double slowest_s = 0.0;     ///< longest call to the device so far, the one in progress included
};

/// start and stop are called from one thread at a time, all else from any thread at any time; none
/// of post, take_done and status ever waits for the device.
/// All lights are dark after stop() and after destruction, as far as the device can be told.
class LightSwitch {
 public:
  virtual ~LightSwitch() = default;
  LightSwitch(const LightSwitch&) = delete;
  LightSwitch& operator=(const LightSwitch&) = delete;

  /// Finds the device and turns all lights dark. Does nothing where it runs already.
  /// @errors  kNotFound, kNotPermitted, kInconsistent (a line is in use by another program); the
  ///          state is then kFailed and the message the error's.
  [[nodiscard]] virtual Result<void> start() = 0;

  /// Turns all lights dark and lets the device go; waits for a call to it that is in progress.
  virtual void stop() = 0;

  /// Wants a light. Requests are served in the order of posting; of several that are due only the
  /// last is carried out.
  /// @return  the request's number, counting from 1 since start(); 0 where the switch does not run
  virtual std::int64_t post(const LightRequest& request) = 0;

  /// What was done since the last call, in order; the oldest are forgotten beyond a thousand. The
  /// latest request is carried out again, under its old number, by a device that was lost.
  [[nodiscard]] virtual std::vector<LightSwitching> take_done() = 0;

  [[nodiscard]] virtual LightSwitchStatus status() const = 0;

 protected:
  LightSwitch() = default;
};

}  // namespace flytri::device
