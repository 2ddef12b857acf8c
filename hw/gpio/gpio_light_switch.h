/// @file  The lights on GPIO lines: a thread of its own serves the requests, so that a chip that
/// blocks holds nobody up.
#pragma once

#include <memory>

#include "hw/gpio/gpio_lines.h"

namespace flytri::gpio {

struct GpioLightSwitchOptions {
  /// > 0. So often a chip that is lost is looked for, and one that is idle is looked after.
  double search_period_s = 0.25;
  /// > 0. A call that takes longer is a fault worth a message: good chips take milliseconds.
  double slow_call_s = 0.5;
  [[nodiscard]] Result<void> validate() const;
};

class GpioLightSwitch final : public device::LightSwitch {
 public:
  /// Nothing is opened before start().
  /// @errors  kBadOption.
  [[nodiscard]] static Result<std::unique_ptr<GpioLightSwitch>> create(
      const LightWiring& wiring, const GpioLightSwitchOptions& options = {});
  /// With lines of the caller's, for tests.
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
