/// @file  Interface to the GPIO lines of the lights.
#pragma once

#include <functional>
#include <memory>

#include "core/base/result.h"
#include "hw/device/light_switch.h"

namespace flytri::gpio {

/// Owns the lines from construction to destruction, and turns all lights off at both.
class LightLines {
 public:
  virtual ~LightLines() = default;
  LightLines(const LightLines&) = delete;
  LightLines& operator=(const LightLines&) = delete;

  /// Turns one light on and the others off. May block for seconds if the chip does not answer.
  /// @return  0 if the device reported success (the light may still not have changed), or the errno
  [[nodiscard]] virtual int set(device::Light light) = 0;

  /// Whether the device is plugged in. Does not block.
  [[nodiscard]] virtual bool present() const = 0;

 protected:
  LightLines() = default;
};

/// Finds and requests the lines. May block as `set` does.
/// @errors  As LightSwitch::start.
using OpenLightLines = std::function<Result<std::unique_ptr<LightLines>>()>;

}  // namespace flytri::gpio
