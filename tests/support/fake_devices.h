/// @file  States of a rig's devices for the window, without devices.
#pragma once

#include <memory>

#include "core/scan/scan_snapshot.h"
#include "ui/state/devices_state.h"
#include "ui/text/texts.h"

namespace flytri::testing {

/// Two cameras and a light switch, all running.
[[nodiscard]] ui::DevicesState running_devices(const ui::Texts& texts);
/// The texture camera is unplugged, and the projectors' cables are swapped.
[[nodiscard]] ui::DevicesState faulty_devices(const ui::Texts& texts);

/// The frame with `factor` times the exposure.
[[nodiscard]] std::shared_ptr<const scan::LiveFrame> exposed(const scan::LiveFrame& frame,
                                                             double factor);

}  // namespace flytri::testing
