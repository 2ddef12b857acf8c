/// @file  A GPIO chip that is open. Hides libgpiod, whose versions 1 and 2 have no call in common:
///        libgpiod_v1.cpp and libgpiod_v2.cpp implement this, and one of them is compiled.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "hw/gpio/gpio_chips.h"

namespace flytri::gpio {

/// Output lines that this program holds. Its end releases them.
class HeldLines {
 public:
  HeldLines() = default;
  virtual ~HeldLines() = default;
  HeldLines(const HeldLines&) = delete;
  HeldLines& operator=(const HeldLines&) = delete;
  /// @param values  0 or 1, in the order in which the lines were asked for
  /// @return  0, or why it failed, as an errno
  virtual int set(const std::vector<int>& values) = 0;
};

class OpenChip {
 public:
  OpenChip() = default;
  virtual ~OpenChip() = default;
  OpenChip(const OpenChip&) = delete;
  OpenChip& operator=(const OpenChip&) = delete;
  [[nodiscard]] virtual std::string label() const = 0;
  /// By their numbers. A line that cannot be read is listed without name and consumer.
  [[nodiscard]] virtual std::vector<GpioLine> lines() const = 0;
  /// Takes lines as outputs with these values. The chip must outlive them.
  /// @return  null: it failed; errno says why
  [[nodiscard]] virtual std::unique_ptr<HeldLines> hold(const std::vector<unsigned>& lines,
                                                        const std::vector<int>& values) = 0;
};

/// @return  null: it cannot be opened; errno says why
[[nodiscard]] std::unique_ptr<OpenChip> open_chip(const std::string& node);

}  // namespace flytri::gpio
