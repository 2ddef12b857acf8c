/// @file  Simulates the calibration images of a virtual sensor.
#pragma once

#include <cstdint>
#include <filesystem>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/base/workers.h"
#include "core/calibration/record/calibration_set.h"
#include "hw/simulated/optics/sensor_model.h"

namespace flytri::simulated {

struct CalibrationSetOptions {
  SensorModel sensor = intraoral_sensor();
  int plane_count = 17;  ///< 5..100, at equal distances
  /// 1..1.5. Depth range of the planes relative to the volume's depth. A little more than 1 keeps
  /// the fits accurate at the ends of the volume. Default for the intra-oral sensor: -8 to 8 mm.
  double depth_share = 16.0 / 15.0;
  int exposures = 16;  ///< 1..1000, averaged into each image
  int bits = 16;       ///< 8 or 16, of the measurement camera's images
  bool noise = true;
  std::uint64_t seed = 1;
  bool has_texture = true;  ///< false: the sensor has no texture camera
  /// -10..10. Angles by which the stage misses the right angle to the target, towards x and y.
  Vec2 stage_tilt_deg = Vec2::Zero();
  [[nodiscard]] Result<void> validate() const;
};

/// Creates the images of all planes in memory.
/// @errors  kBadOption, kCancelled.
[[nodiscard]] Result<calibration::CalibrationSet> take_calibration_set(
    const CalibrationSetOptions& options, const Workers& workers, const Progress& progress);

/// Creates the images and writes them to a folder in the format of docs/formats.md.
/// @errors  As take_calibration_set and write_calibration_set.
[[nodiscard]] Result<void> simulate_calibration_set(const CalibrationSetOptions& options,
                                                    const std::filesystem::path& folder,
                                                    const Workers& workers,
                                                    const Progress& progress);

}  // namespace flytri::simulated
