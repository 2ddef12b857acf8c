/// @file  Opens the source of a session's frames.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "app/session/scanned_object.h"
#include "core/base/progress.h"
#include "core/calibration/record/calibration.h"
#include "hw/device/sensor.h"
#include "hw/device/steerable_hand.h"
#include "hw/recording/recorder_sensor.h"
#include "hw/rig/rig_sensor.h"
#include "hw/rig/rig_settings.h"
#include "ui/state/app_view.h"

namespace flytri::session {

/// Names in source_table().
inline constexpr std::string_view kRecordingSource = "recording";
inline constexpr std::string_view kRigSource = "rig";

/// The source that the user chose.
struct SourceChoice {
  std::string_view name;       ///< in source_table(); empty: the virtual sensor
  std::filesystem::path path;  ///< the recording's folder, the rig's file; as the name asks
  std::optional<std::filesystem::path> calibration;  ///< replaces the one that the source names
  double replay_speed = 1.0;                         ///< > 0; 0: as fast as possible
  std::string sensor = "intraoral";                  ///< the virtual one, or "face"
  ScannedObject object;                              ///< of the virtual sensor
  bool is_given = false;  ///< the command line names the virtual sensor or its object
  std::optional<std::uint64_t> fault_seed;  ///< for tests: makes the source fail now and then

  [[nodiscard]] bool is_virtual() const { return name.empty(); }
  [[nodiscard]] bool is_rig() const { return name == kRigSource; }
};

/// The rig of a source with devices.
struct RigSource {
  std::shared_ptr<rig::Rig> sensor;
  rig::RigSettings settings;
};

struct Source {
  ui::SourceKind kind = ui::SourceKind::kSimulated;
  std::shared_ptr<device::Sensor> sensor;
  std::shared_ptr<device::SteerableHand> hand;  ///< of a simulated sensor; null otherwise
  std::shared_ptr<const calibration::Calibration> calibration;
  std::optional<RigSource> rig;
  std::shared_ptr<recording::RecorderSensor> recorder;  ///< is the sensor; null of a recording
  std::string warning;                                  ///< for the user; empty: none
  std::filesystem::path calibration_file = {};          ///< of a virtual sensor or a rig
};

/// A kind of source. To add one, add its row: the command line makes an option of it.
struct SourceRow {
  std::string_view name;  ///< the option is --NAME PATH
  const char* help;
  Result<Source> (*open)(const SourceChoice& choice, const ui::Texts& texts);
};

/// All sources but the virtual sensor, which is used where none is chosen.
[[nodiscard]] std::span<const SourceRow> source_table();

/// The first use of the virtual sensor takes seconds, because it is calibrated then.
/// @param texts  for messages
/// @errors  As for reading the recording, the rig, the calibration or the mesh; kCancelled.
[[nodiscard]] Result<Source> open_source(const SourceChoice& choice, const Progress& progress,
                                         const ui::Texts& texts = {});

}  // namespace flytri::session
