/// @file  What setup works with: the devices of this machine, or those of a test.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "core/base/progress.h"
#include "hw/device/clock.h"
#include "hw/gpio/gpio_chips.h"
#include "hw/rig/camera_drivers.h"
#include "hw/rig/rig.h"
#include "hw/setup/setup_talk.h"
#include "hw/shots/check_linearity.h"

namespace flytri::setup {

struct SetupMachine {
  rig::CameraDrivers drivers;
  std::function<std::vector<gpio::GpioChip>()> list_chips;
  shots::OpenDevices open;
  std::function<Result<std::shared_ptr<rig::Rig>>(const rig::RigSettings&)> open_rig;
  device::Clock clock;
};

[[nodiscard]] SetupMachine this_machine();

/// The devices, the person, and whether the work was canceled.
struct SetupContext {
  const SetupMachine& machine;
  SetupTalk& talk;
  const Progress& progress;
  double rate_hz = 30.0;  ///< > 0, frame rate to aim for

  /// As SetupTalk::choose.
  /// @errors  kCancelled: the user stops.
  [[nodiscard]] Result<std::size_t> choose(const std::string& question,
                                           const std::vector<std::string>& answers,
                                           std::size_t suggested = 0) const;
};

}  // namespace flytri::setup
