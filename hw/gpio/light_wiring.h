/// @file  Which lines of which GPIO chip turn on which light.
#pragma once

#include <optional>
#include <string>

#include "core/base/result.h"
#include "hw/device/light_switch.h"

namespace flytri::gpio {

/// Which chip is meant: what is given must all agree, and exactly one chip must be left.
struct ChipMatch {
  std::string label;     ///< the whole of it, e.g. "ftdi-cbus"; gpioinfo tells it
  std::string serial;    ///< of the USB device, the whole number
  std::string bus_path;  ///< where it is plugged in, the whole path
};

/// A line of the chip, by its name or by its number.
struct LineMatch {
  std::string name;           ///< empty: by number
  std::optional<int> offset;  ///< >= 0; not with a name
  bool active_low = false;    ///< the light shines while the line is low
};

struct LightWiring {
  ChipMatch chip;  ///< something of it must be given
  LineMatch vertical;
  LineMatch horizontal;
  std::optional<LineMatch> flash;  ///< a rig without one has no texture
  [[nodiscard]] Result<void> validate() const;
};

}  // namespace flytri::gpio
