/// @file  Opens what the frames of a session come from.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>

#include "core/base/progress.h"
#include "core/calibration/calibration.h"
#include "hw/device/sensor.h"
#include "hw/device/steerable_hand.h"
#include "ui/app_view.h"

namespace flytri {

/// What the user chose.
struct SourceChoice {
  std::optional<std::filesystem::path> recording;    ///< a folder to be replayed
  std::optional<std::filesystem::path> calibration;  ///< instead of the one the recording names
  double replay_speed = 1.0;                         ///< > 0; 0: as fast as the frames are taken
  std::optional<std::filesystem::path> mesh;         ///< what the virtual sensor scans
  std::optional<std::uint64_t> fault_seed;           ///< for tests: the source fails now and then
};

struct Source {
  ui::SourceKind kind = ui::SourceKind::kSimulated;
  std::shared_ptr<Sensor> sensor;
  std::shared_ptr<SteerableHand> hand;  ///< of a simulated sensor; null otherwise
  std::shared_ptr<const Calibration> calibration;
};

/// Takes seconds the first time the virtual sensor is used: it is calibrated then.
/// @errors  Of the recording, the calibration or the mesh; kCancelled.
[[nodiscard]] Result<Source> open_source(const SourceChoice& choice, const Progress& progress);

}  // namespace flytri
