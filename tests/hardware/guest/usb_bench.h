/// @file  Controls the program that emulates the USB devices.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace flytri::testing {

/// Sends a command, e.g. "unplug camera".
void send_command(const std::string& line);

/// The pins that are on, as bits: 0 vertical, 1 horizontal, 2 flash.
[[nodiscard]] unsigned lit_pins();

/// A change of the pins.
struct PinEdge {
  double time_s = 0.0;  ///< on the monotonic clock
  unsigned pins = 0;    ///< as lit_pins()
};
/// All changes since `from_s`, in order.
[[nodiscard]] std::vector<PinEdge> pin_edges(double from_s);

/// Waits until the condition is fulfilled. Fails the test after `limit_s`.
void wait_until(const std::function<bool()>& reached, double limit_s = 20.0);

/// Longest time to plug in a device. This kernel's driver for the MCP2221 ignores answers during
/// its start, and waits four seconds for each of six.
inline constexpr double kPlugging_s = 60.0;

/// Plugs in all devices, ends their faults, and waits until the kernel has detected them.
void restore_all();

}  // namespace flytri::testing
