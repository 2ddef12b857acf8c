/// @file  The lines of the lights on a GPIO chip of the machine, through libgpiod.
#pragma once

#include "hw/gpio/light_lines.h"
#include "hw/gpio/light_wiring.h"

namespace flytri {

/// Takes hold of the lines as outputs, all dark, and starts their guard (hw/gpio/dark_guard.h).
/// @errors  kNotFound, kNotPermitted, kInconsistent (several chips match, a line is held by
/// somebody
///          else, or no guard can be started); the message says which and the remedy
[[nodiscard]] Result<std::unique_ptr<LightLines>> open_gpio_lines(const LightWiring& wiring);

}  // namespace flytri
