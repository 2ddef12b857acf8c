/// @file  Which GPIO line switches which light.
#pragma once

#include <optional>
#include <string>

#include "core/base/result.h"
#include "hw/device/light_limits.h"

namespace flytri::gpio {

/// Selects a chip: every given field must match, and exactly one chip may match.
struct ChipMatch {
  std::string label;     ///< the whole label, e.g. "ftdi-cbus"; `gpioinfo` shows it
  std::string serial;    ///< the whole serial number of the USB device
  std::string bus_path;  ///< the whole bus path of its USB socket
};

/// Selects a line of the chip, by name or by number.
struct LineMatch {
  std::string name;           ///< empty: select by number
  std::optional<int> offset;  ///< >= 0; only without a name
  bool active_low = false;    ///< the light is on while the line is low
};

struct LightWiring {
  ChipMatch chip;  ///< at least one field must be given
  LineMatch vertical;
  LineMatch horizontal;
  std::optional<LineMatch> flash;  ///< without a flash, the rig has no texture
  device::LightLimits limits;
  [[nodiscard]] Result<void> validate() const;
};

}  // namespace flytri::gpio
