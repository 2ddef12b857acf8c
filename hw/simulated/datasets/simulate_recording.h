/// @file  Simulates a scan of a mesh and writes the recording with its true poses.
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

/// Faults during the scan.
struct RecordingFaults {
  double dropped_share = 0.0;     ///< 0..0.9, share of frames that are missing
  bool unknown_patterns = false;  ///< projector not synchronized: frame kinds are `unknown`
  double away_start_s = 0.0;      ///< >= 0, when the hand lifts the sensor off ...
  double away_duration_s = 0.0;   ///< >= 0, ... and for how long; 0: never
  double bump_mm = 0.0;    ///< by which the projector of the vertical lines moves across them ...
  double bump_at_s = 0.0;  ///< >= 0, ... from this time of the scan on
  double tissue_share = 0.0;  ///< 0..0.5, share of the time with a tongue or a finger in view
  [[nodiscard]] Result<void> validate() const;
};

struct RecordingOptions {
  SensorModel sensor = intraoral_sensor();
  PathOptions path;                                ///< movement of the hand
  std::optional<std::filesystem::path> path_file;  ///< use the poses of this truth.json instead
  double texture_period_s = 1.0;                   ///< >= 0; 0: no texture frames
  std::string calibration;  ///< relative path for recording.json; empty: none
  ImageOptions image;
  RecordingFaults faults;
  [[nodiscard]] Result<void> validate() const;
};

struct RecordingCounts {
  int measurement = 0;  ///< frames written
  int texture = 0;      ///< frames written
  int dropped = 0;      ///< frames dropped by a fault
};

/// Writes recording.json, frames/, truth.json and the mesh to `folder`. The mesh is model.ply, with
/// the result of count_lit as the vertex property "lit". The output is bit-identical for any number
/// of threads. If cancelled, the recording is valid but shorter.
/// @param mesh  model frame, mm; counter-clockwise from outside
/// @errors  kBadOption, kInsufficient, kCancelled; as read_path, RecordingWriter, write_truth,
///          write_model.
[[nodiscard]] Result<RecordingCounts> simulate_recording(const TriangleMesh& mesh,
                                                         const RecordingOptions& options,
                                                         const std::filesystem::path& folder,
                                                         const Workers& workers,
                                                         const Progress& progress);

}  // namespace flytri::simulated
