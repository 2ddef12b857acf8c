/// @file  Light switch on GPIO lines. Carries out requests on its own thread, so that a slow chip
/// does not block the caller.
#pragma once

#include <memory>

#include "hw/gpio/gpio_lines.h"

namespace flytri::gpio {

struct GpioLightSwitchOptions {
  /// > 0. Time between searches for a lost chip, and between checks that an idle chip is present.
  double search_period_s = 0.25;
  /// > 0. A longer call is reported in the status; it normally takes milliseconds.
  double slow_call_s = 0.5;
  device::LightLimits limits;
  [[nodiscard]] Result<void> validate() const;
};

class GpioLightSwitch final : public device::LightSwitch {
 public:
  /// Opens no device before start().
  /// @param options  its limits are replaced by those of the wiring
  /// @errors  kBadOption.
  [[nodiscard]] static Result<std::unique_ptr<GpioLightSwitch>> create(
      const LightWiring& wiring, const GpioLightSwitchOptions& options = {});
  /// Uses lines of the caller, for tests.
  /// @errors  kBadOption.
  [[nodiscard]] static Result<std::unique_ptr<GpioLightSwitch>> create(
      OpenLightLines open, const GpioLightSwitchOptions& options = {});
  ~GpioLightSwitch() override;

  [[nodiscard]] Result<void> start() override;
  void stop() override;
  std::int64_t post(const device::LightRequest& request) override;
  [[nodiscard]] std::vector<device::LightSwitching> take_done() override;
  [[nodiscard]] device::LightSwitchStatus status() const override;

 private:
  struct Worker;
  explicit GpioLightSwitch(std::unique_ptr<Worker> worker);
  std::unique_ptr<Worker> worker_;
};

}  // namespace flytri::gpio
