/// @file  The lights on the outputs of a sequencer.
#pragma once

#include <memory>
#include <string>

#include "hw/gpio/light_lines.h"
#include "hw/gpio/light_wiring.h"
#include "hw/gpio/sequencer.h"

namespace flytri::gpio {

/// The sequencer that is meant, by the wiring's chip.
/// @errors  As find_chip and Sequencer::open; kBadOption: the chip is no sequencer, a light has no
///          number of an output, or is active low.
[[nodiscard]] Result<std::unique_ptr<Sequencer>> open_sequencer(const LightWiring& wiring);

/// Needs no guard process: the sequencer turns the lights off when this program is silent.
/// @param node  device file of its serial port
/// @errors  As Sequencer::open; kBadOption: a light has no number of an output, or is active low.
[[nodiscard]] Result<std::unique_ptr<LightLines>> open_sequencer_lines(const std::string& node,
                                                                       const LightWiring& wiring);

}  // namespace flytri::gpio
