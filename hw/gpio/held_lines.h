/// @file  Output lines of a GPIO chip, requested from the kernel by system calls.
#pragma once

#include <linux/gpio.h>

#include <string_view>
#include <vector>

namespace flytri::gpio {

/// A request for output lines with these values, in the second version of the kernel's interface
/// (Linux 5.10): kernels of Debian after 13 lack the first.
/// @param lines  numbers on the chip; the kernel takes at most 64
/// @param values  0 or 1, in the order of the lines
/// @param consumer  name that other programs see
[[nodiscard]] gpio_v2_line_request output_request(const std::vector<unsigned>& lines,
                                                  const std::vector<int>& values,
                                                  std::string_view consumer);

/// Sets lines of a granted request. Makes only a system call, so a forked child may use it.
/// @param values  of output_request()
/// @return  0, or why it failed, as an errno
int set_lines(int descriptor, const gpio_v2_line_values& values);

/// The values of all lines of a request, as set_lines() takes them.
[[nodiscard]] gpio_v2_line_values values_of(const std::vector<int>& values);

/// Output lines that this program holds. Its end releases them; they keep their values.
class HeldLines {
 public:
  /// @param descriptor  of a granted request; HeldLines closes it
  explicit HeldLines(int descriptor) : descriptor_(descriptor) {}
  ~HeldLines();
  HeldLines(const HeldLines&) = delete;
  HeldLines& operator=(const HeldLines&) = delete;

  /// @param values  0 or 1, in the order in which the lines were requested
  /// @return  0, or why it failed, as an errno
  int set(const std::vector<int>& values) { return set_lines(descriptor_, values_of(values)); }
  [[nodiscard]] int descriptor() const { return descriptor_; }

 private:
  const int descriptor_;
};

}  // namespace flytri::gpio
