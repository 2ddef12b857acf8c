/// @file  Devices of a rig as the window shows them, without a device.
#pragma once

#include <memory>

#include "core/scan/scan_snapshot.h"
#include "ui/state/devices_state.h"

namespace flytri::testing {

/// Two cameras and a switch that run.
[[nodiscard]] ui::DevicesState running_devices();
/// The texture camera is unplugged, and the projectors' cables are swapped.
[[nodiscard]] ui::DevicesState faulty_devices();

/// The same frame, exposed so many times as long.
[[nodiscard]] std::shared_ptr<const scan::LiveFrame> exposed(const scan::LiveFrame& frame,
                                                             double factor);

}  // namespace flytri::testing
