/// @file  Simulates the images that both cameras of a virtual sensor take of its calibration
/// targets.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

#include "core/base/result.h"
#include "core/calibration/guide/calibration_plan.h"
#include "hw/simulated/optics/chip.h"
#include "hw/simulated/optics/dot_image.h"
#include "hw/simulated/optics/image_simulator.h"

namespace flytri::simulated {

/// The sensor with half the exposure: at the near end of the volume, lines on white are twice as
/// bright as in the middle.
[[nodiscard]] SensorModel exposed_for_targets(SensorModel sensor);

/// Immutable and thread-safe; an image depends only on the arguments.
class CalibrationCamera {
 public:
  struct Options {
    int exposures = 16;  ///< 1..1000, averaged into each image
    int bits = 16;       ///< 8 or 16, of the measurement camera's images
    bool noise = true;
    std::uint64_t seed = 1;
    /// The stage does not move at right angles to the target: the dots move aside by this, per
    /// depth.
    Vec2 stage_shear = Vec2::Zero();
  };
  /// @errors  As ImageSimulator::create.
  [[nodiscard]] static Result<CalibrationCamera> create(const SensorModel& sensor,
                                                        const Options& options);

  /// @param stream  random stream of the noise
  /// @return  in the format of GuidedCalibration::take
  [[nodiscard]] cv::Mat take(calibration::ShotKind kind, double z_mm, std::uint64_t stream) const;

 private:
  CalibrationCamera(const SensorModel& sensor, const Options& options, ImageSimulator simulator);
  [[nodiscard]] Isometry dots_at(double z_mm) const;
  [[nodiscard]] cv::Mat lines(Pattern pattern, double z_mm, std::uint64_t stream) const;
  [[nodiscard]] cv::Mat evenly_lit(const cv::Mat& light, std::uint64_t stream) const;

  SensorModel sensor_;
  Options options_;
  ImageSimulator simulator_;
  Chip chip_;
  DotImage dots_, texture_dots_;
};

}  // namespace flytri::simulated
