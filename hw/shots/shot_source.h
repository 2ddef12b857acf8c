/// @file  Where the images of a guided calibration come from: a rig, or the virtual sensor.
#pragma once

#include <opencv2/core.hpp>
#include <string>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/calibration/guide/calibration_plan.h"

namespace flytri::shots {

/// Used by one thread at a time. All lights are dark after stop() and after destruction.
class ShotSource {
 public:
  virtual ~ShotSource() = default;
  ShotSource(const ShotSource&) = delete;
  ShotSource& operator=(const ShotSource&) = delete;

  /// @errors  Of the devices: what is missing, and the remedy.
  [[nodiscard]] virtual Result<void> start() = 0;
  virtual void stop() = 0;

  /// Lights the target as the shot needs it, and takes its image.
  /// @param z_mm  where the target is to be; a real one is where the user put it
  /// @return  as GuidedCalibration::take asks for it
  /// @errors  As start; kCancelled.
  [[nodiscard]] virtual Result<cv::Mat> take(calibration::ShotKind kind, double z_mm,
                                             const Progress& progress) = 0;

  /// What the camera of such a shot sees now, of one exposure: for who puts the target into place.
  /// @errors  As take.
  [[nodiscard]] virtual Result<cv::Mat> look(calibration::ShotKind kind, double z_mm,
                                             const Progress& progress) = 0;

  /// What a user calls it.
  [[nodiscard]] virtual std::string name() const = 0;

 protected:
  ShotSource() = default;
};

}  // namespace flytri::shots
