/// @file  A switch of lights that is none: it keeps times and faults as real ones have them.
#pragma once

#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

#include "hw/device/clock.h"
#include "hw/device/light_switch.h"
#include "hw/device/request_queue.h"
#include "hw/sync/light_history.h"

namespace flytri::simulated {

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

/// Requests are carried out as the clock passes them; nothing waits, no thread runs.
class SimulatedLights final : public device::LightSwitch {
 public:
  /// @param options  valid ones
  SimulatedLights(const SimulatedLightsOptions& options, device::Clock clock);

  [[nodiscard]] Result<void> start() override;
  void stop() override;
  std::int64_t post(const device::LightRequest& request) override;
  [[nodiscard]] std::vector<device::LightSwitching> take_done() override;
  [[nodiscard]] device::LightSwitchStatus status() const override;

  /// What truly shone; up to the clock's present.
  [[nodiscard]] sync::LightTimes truth(double from_s, double to_s);
  /// From now on these are wrong.
  void set_faults(const LightFaults& faults);
  /// The device is unplugged or plugged in again: dark, and nothing is carried out.
  void set_plugged(bool is_plugged);

 private:
  void advance();
  void carry_out(const device::NumberedRequest& request, double begin_s);
  void shine(device::Light light, double from_s);

  const SimulatedLightsOptions options_;
  const device::Clock clock_;
  mutable std::mutex mutex_;  // of all below
  LightFaults faults_;
  bool is_plugged_ = true;
  device::LightSwitchStatus status_;
  double free_s_ = 0.0;  // the device is busy until then
  device::RequestQueue requests_;
  std::vector<device::LightSwitching> done_;
  sync::LightHistory truth_;
};

}  // namespace flytri::simulated
