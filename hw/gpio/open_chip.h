/// @file  A GPIO chip that is open: its label, its lines, and the request for them.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "hw/gpio/gpio_chips.h"
#include "hw/gpio/held_lines.h"

namespace flytri::gpio {

class OpenChip {
 public:
  /// @param descriptor  of the chip's device file; OpenChip closes it
  OpenChip(int descriptor, std::string label, unsigned line_count)
      : descriptor_(descriptor), label_(std::move(label)), line_count_(line_count) {}
  ~OpenChip();
  OpenChip(const OpenChip&) = delete;
  OpenChip& operator=(const OpenChip&) = delete;

  [[nodiscard]] const std::string& label() const { return label_; }
  /// By their numbers. A line that cannot be read is listed without name and consumer.
  [[nodiscard]] std::vector<GpioLine> lines() const;
  /// Takes lines as outputs with these values; see output_request().
  /// @return  null: it failed; errno says why
  [[nodiscard]] std::unique_ptr<HeldLines> hold(const std::vector<unsigned>& lines,
                                                const std::vector<int>& values);

 private:
  const int descriptor_;
  const std::string label_;
  const unsigned line_count_;
};

/// @return  null: it cannot be opened, or is no GPIO chip; errno says why
[[nodiscard]] std::unique_ptr<OpenChip> open_chip(const std::string& node);

}  // namespace flytri::gpio
