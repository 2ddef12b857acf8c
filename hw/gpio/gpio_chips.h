/// @file  Which GPIO chips and sequencers there are, found by what does not change when they are
/// plugged in again.
#pragma once

#include <string>
#include <vector>

#include "core/base/result.h"
#include "hw/device/device_node.h"
#include "hw/gpio/light_wiring.h"

namespace flytri::gpio {

struct GpioLine {
  std::string name;      ///< empty where it has none
  std::string consumer;  ///< who holds it; empty where it is free
};

/// A chip as it is listed. A sequencer (sequencer.h) is listed as a chip whose label is
/// kSequencerName and whose lines are its outputs.
struct GpioChip {
  device::DeviceNode device;
  std::string label = {};            ///< empty where it may not be opened
  std::vector<GpioLine> lines = {};  ///< by their numbers
  /// What keeps it from being used, with the remedy; empty: nothing.
  std::vector<Error> problems = {};
  bool is_sequencer = false;
};

/// Every chip, those that cannot be used among them.
[[nodiscard]] std::vector<GpioChip> list_chips();

/// The one chip that is meant.
/// @errors  kNotFound with those that there are; kNotPermitted; kInconsistent: several match
[[nodiscard]] Result<GpioChip> find_chip(const std::vector<GpioChip>& chips,
                                         const ChipMatch& match);

/// A line's number on the chip.
/// @errors  kNotFound with those that there are; kInconsistent: somebody else holds it
[[nodiscard]] Result<unsigned> find_line(const GpioChip& chip, const LineMatch& match);

/// The numbers of the lights' lines: vertical, horizontal, and flash where the rig has one.
/// @errors  As find_line; kBadOption: two lights have the same, one by name and one by number.
[[nodiscard]] Result<std::vector<unsigned>> find_lines(const GpioChip& chip,
                                                       const LightWiring& wiring);

}  // namespace flytri::gpio
