/// @file  A number that tells sensor models apart, so that what was made for one is not taken for
/// another.
#pragma once

#include <cstdint>

#include "hw/simulated/optics/sensor_model.h"

namespace flytri::simulated {

/// FNV-1a over the bits of every number of the model: another in any of them is another
/// fingerprint.
/// @source  Fowler, Noll, Vo, "The FNV Non-Cryptographic Hash Algorithm", IETF draft.
[[nodiscard]] std::uint64_t fingerprint(const SensorModel& sensor);

}  // namespace flytri::simulated
