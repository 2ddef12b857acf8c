/// @file  A switch of lights that is none: it keeps times and faults as real ones have them.
#pragma once

#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

#include "hw/device/clock.h"
#include "hw/device/light_switch.h"
#include "hw/device/wish_queue.h"
#include "hw/sync/light_history.h"

namespace flytri {

/// What is wrong with it; all of this still reports success.
struct LightFaults {
  bool is_swapped = false;   ///< vertical and horizontal
  bool is_mute = false;      ///< nothing ever changes
  bool no_vertical = false;  ///< dark instead
  bool no_horizontal = false;
  bool no_flash = false;
};

struct SimulatedLightsOptions {
  double call_s = 0.002;  ///< >= 0, how long a call to the device takes
  double act_s = 0.001;   ///< >= 0, from the beginning of the call to the light
  LightFaults faults;
  [[nodiscard]] Result<void> validate() const;
};

/// Wishes are carried out as the clock passes them; nothing waits, no thread runs.
class SimulatedLights final : public LightSwitch {
 public:
  /// @param options  valid ones
  SimulatedLights(const SimulatedLightsOptions& options, Clock clock);

  [[nodiscard]] Result<void> start() override;
  void stop() override;
  std::int64_t post(const LightWish& wish) override;
  [[nodiscard]] std::vector<LightSwitching> take_done() override;
  [[nodiscard]] LightSwitchStatus status() const override;

  /// What truly shone; up to the clock's present.
  [[nodiscard]] LightTimes truth(double from_s, double to_s);
  /// From now on these are wrong.
  void set_faults(const LightFaults& faults);
  /// The device is unplugged or plugged in again: dark, and nothing is carried out.
  void set_plugged(bool is_plugged);

 private:
  void advance();
  void carry_out(const NumberedWish& wish, double begin_s);
  void shine(Light light, double from_s);

  const SimulatedLightsOptions options_;
  const Clock clock_;
  mutable std::mutex mutex_;  // of all below
  LightFaults faults_;
  bool is_plugged_ = true;
  LightSwitchStatus status_;
  double free_s_ = 0.0;  // the device is busy until then
  WishQueue wishes_;
  std::vector<LightSwitching> done_;
  LightHistory truth_;
};

}  // namespace flytri
