/// @file  A GPIO chip that is open, closed again by whoever holds it.
#pragma once

#include <gpiod.h>

#include <memory>
#include <string>

namespace flytri::gpio {

struct ChipCloser {
  /// Its lines are let go with it.
  void operator()(gpiod_chip* chip) const { gpiod_chip_close(chip); }
};
using OpenChip = std::unique_ptr<gpiod_chip, ChipCloser>;

/// @return  null: it cannot be opened; errno says why
[[nodiscard]] inline OpenChip open_chip(const std::string& node) {
  return OpenChip(gpiod_chip_open(node.c_str()));
}

}  // namespace flytri::gpio
