/// @file  The lines of the lights on a GPIO chip of the machine.
#pragma once

#include "hw/gpio/light_lines.h"
#include "hw/gpio/light_wiring.h"

namespace flytri::gpio {

/// Takes hold of the lines as outputs, all dark, and starts their guard (hw/gpio/dark_guard.h).
/// @errors  kBadOption; kNotFound, kNotPermitted; kInconsistent: several chips match, somebody else
///          holds a line, or no guard can be started. The message says which, and the remedy.
[[nodiscard]] Result<std::unique_ptr<LightLines>> open_gpio_lines(const LightWiring& wiring);

}  // namespace flytri::gpio
