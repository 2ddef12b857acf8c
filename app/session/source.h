/// @file  Opens the source of a session's frames.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>

#include "core/base/progress.h"
#include "core/calibration/record/calibration.h"
#include "hw/device/sensor.h"
#include "hw/device/steerable_hand.h"
#include "hw/rig/rig_sensor.h"
#include "hw/rig/rig_settings.h"
#include "ui/state/app_view.h"

namespace flytri::session {

/// The source that the user chose.
struct SourceChoice {
  std::optional<std::filesystem::path> recording;  ///< a folder to replay
  std::optional<std::filesystem::path> rig;        ///< a rig.json: real devices
  std::optional<std::filesystem::path>
      calibration;                            ///< replaces the one that the recording or rig names
  double replay_speed = 1.0;                  ///< > 0; 0: as fast as possible
  std::optional<std::filesystem::path> mesh;  ///< the object that the virtual sensor scans
  std::optional<std::uint64_t> fault_seed;    ///< for tests: makes the source fail now and then
};

/// The rig of a source with devices.
struct RigSource {
  std::shared_ptr<rig::RigSensor> sensor;
  rig::RigSettings settings;
};

struct Source {
  ui::SourceKind kind = ui::SourceKind::kSimulated;
  std::shared_ptr<device::Sensor> sensor;
  std::shared_ptr<device::SteerableHand> hand;  ///< of a simulated sensor; null otherwise
  std::shared_ptr<const calibration::Calibration> calibration;
  std::optional<RigSource> rig;
};

/// The first use of the virtual sensor takes seconds, because it is calibrated then.
/// @errors  As for reading the recording, the rig, the calibration or the mesh; kCancelled.
[[nodiscard]] Result<Source> open_source(const SourceChoice& choice, const Progress& progress);

}  // namespace flytri::session
