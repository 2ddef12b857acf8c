/// @file  Scans a mesh with a virtual sensor and writes what it saw as a recording with its truth.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/base/workers.h"
#include "core/geometry/triangle_mesh.h"
#include "hw/simulated/optics/image_simulator.h"
#include "hw/simulated/optics/sensor_model.h"
#include "hw/simulated/optics/sensor_path.h"

namespace flytri::simulated {

/// What goes wrong during a scan.
struct RecordingFaults {
  double dropped_share = 0.0;     ///< 0..0.9, frames that never arrive; time goes on
  bool unknown_patterns = false;  ///< the projector is not synchronized: kinds are `unknown`
  double away_start_s = 0.0;      ///< >= 0, when the hand takes the sensor away ...
  double away_duration_s = 0.0;   ///< >= 0, ... and for how long; 0: never
  [[nodiscard]] Result<void> validate() const;
};

struct RecordingOptions {
  SensorModel sensor = intraoral_sensor();
  PathOptions path;                                ///< how the hand moves
  std::optional<std::filesystem::path> path_file;  ///< a truth.json to follow instead
  double texture_period_s = 1.0;                   ///< >= 0; 0: no texture frames
  std::string calibration;  ///< what recording.json is to name, relative; empty: nothing
  ImageOptions image;
  RecordingFaults faults;
  [[nodiscard]] Result<void> validate() const;
};

struct RecordingCounts {
  int measurement = 0;  ///< frames written
  int texture = 0;      ///< frames written
  int dropped = 0;      ///< frames that a fault took
};

/// Writes recording.json, frames/, truth.json and the mesh as model.ply, with count_lit as the
/// vertex property "lit", to `folder`. The same
/// bits for any number of threads. When cancelled, what is there is a recording, only shorter.
/// @param mesh  model frame, mm; counter-clockwise from outside
/// @errors  kBadOption, kInsufficient, kCancelled; as read_path, RecordingWriter, write_truth,
///          write_model.
[[nodiscard]] Result<RecordingCounts> simulate_recording(const TriangleMesh& mesh,
                                                         const RecordingOptions& options,
                                                         const std::filesystem::path& folder,
                                                         const Workers& workers,
                                                         const Progress& progress);

}  // namespace flytri::simulated
