/// @file  A hash that identifies a sensor model, used as the key of cached calibrations.
#pragma once

#include <cstdint>

#include "hw/simulated/optics/sensor_model.h"

namespace flytri::simulated {

/// FNV-1a hash over the bits of all numbers of the model.
/// @source  Fowler, Noll, Vo, "The FNV Non-Cryptographic Hash Algorithm", IETF draft.
[[nodiscard]] std::uint64_t fingerprint(const SensorModel& sensor);

}  // namespace flytri::simulated
