/// @file  Simulated light switch, with the delays and faults of a real one.
#pragma once

#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

#include "hw/device/clock.h"
#include "hw/device/light_budget.h"
#include "hw/device/light_switch.h"
#include "hw/device/request_queue.h"
#include "hw/sync/light_history.h"

namespace flytri::simulated {

/// Simulated faults; the switch still reports success.
struct LightFaults {
  bool is_swapped = false;   ///< vertical and horizontal light are swapped
  bool is_mute = false;      ///< the light never changes
  bool no_vertical = false;  ///< dark instead of vertical
  bool no_horizontal = false;
  bool no_flash = false;
};

struct SimulatedLightsOptions {
  double call_s = 0.002;  ///< >= 0, duration of a call to the device
  double act_s = 0.001;   ///< >= 0, delay from the start of the call to the light
  LightFaults faults;
  device::LightLimits limits;
  [[nodiscard]] Result<void> validate() const;
};

/// Carries out requests by the time of the clock, without waiting and without a thread.
class SimulatedLights final : public device::LightSwitch {
 public:
  /// @param options  must be valid
  SimulatedLights(const SimulatedLightsOptions& options, device::Clock clock);

  [[nodiscard]] Result<void> start() override;
  void stop() override;
  std::int64_t post(const device::LightRequest& request) override;
  [[nodiscard]] std::vector<device::LightSwitching> take_done() override;
  [[nodiscard]] device::LightSwitchStatus status() const override;

  /// Which lights were really on, up to the current time of the clock.
  [[nodiscard]] sync::LightTimes truth(double from_s, double to_s);
  /// Sets the faults from now on.
  void set_faults(const LightFaults& faults);
  /// Simulates plugging in or unplugging the device. While unplugged, it is dark and carries out
  /// nothing.
  void set_plugged(bool is_plugged);

 private:
  void advance();
  void carry_out(const device::NumberedRequest& request, double begin_s);
  void turn_dark_until(double end_s);
  void shine(device::Light light, double from_s);

  const SimulatedLightsOptions options_;
  const device::Clock clock_;
  mutable std::mutex mutex_;  // guards all members below
  LightFaults faults_;
  bool is_plugged_ = true;
  device::LightSwitchStatus status_;
  double free_s_ = 0.0;  // time until which the device is busy
  device::RequestQueue requests_;
  device::LightBudget budget_;
  std::int64_t latest_ = 0;  // number of the latest request that was carried out
  std::vector<device::LightSwitching> done_;
  sync::LightHistory truth_;
};

}  // namespace flytri::simulated
