/// @file  Orders to the program that plays the USB devices, and what it says.
#pragma once

#include <functional>
#include <string>

namespace flytri::testing {

/// Sends it a line, e.g. "unplug camera".
void order(const std::string& line);

/// The pins that shine, as bits: 0 vertical, 1 horizontal, 2 flash.
[[nodiscard]] unsigned shining();

/// Waits for a state of the machine. Fails the test after `limit_s`.
void wait_until(const std::function<bool()>& reached, double limit_s = 20.0);

/// The longest that plugging in takes: this kernel's driver of the MCP2221 hears no answers before
/// it is through with its start, and waits four seconds for each of six.
inline constexpr double kPlugging_s = 60.0;

/// Plugs in all devices and ends their faults, and waits until the kernel has them.
void mend_all();

}  // namespace flytri::testing
