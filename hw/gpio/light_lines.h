/// @file  The lines of the lights while they are held: what a switch needs of a GPIO chip.
#pragma once

#include <functional>
#include <memory>

#include "core/base/result.h"
#include "hw/device/light_switch.h"

namespace flytri::gpio {

/// Held from construction to destruction; all lights are dark at both ends.
class LightLines {
 public:
  virtual ~LightLines() = default;
  LightLines(const LightLines&) = delete;
  LightLines& operator=(const LightLines&) = delete;

  /// Turns one light on and the others off. May block for seconds where a chip does not answer.
  /// @return  0, which proves nothing, or the errno
  [[nodiscard]] virtual int set(device::Light light) = 0;

  /// Whether the device is plugged in. Does not block.
  [[nodiscard]] virtual bool present() const = 0;

 protected:
  LightLines() = default;
};

/// Finds the lines and takes hold of them. May block as `set` does.
/// @errors  As LightSwitch::start.
using OpenLightLines = std::function<Result<std::unique_ptr<LightLines>>()>;

}  // namespace flytri::gpio
