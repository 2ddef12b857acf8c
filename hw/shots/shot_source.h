/// @file  Interface of the source of calibration images: a rig or the virtual sensor.
#pragma once

#include <opencv2/core.hpp>
#include <string>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/calibration/guide/calibration_plan.h"
#include "core/geometry/rigid.h"

namespace flytri::shots {

/// Use from one thread at a time. All lights are dark after stop() and after destruction.
class ShotSource {
 public:
  virtual ~ShotSource() = default;
  ShotSource(const ShotSource&) = delete;
  ShotSource& operator=(const ShotSource&) = delete;

  /// @errors  Of the devices: what is missing, and what to do.
  [[nodiscard]] virtual Result<void> start() = 0;
  virtual void stop() = 0;

  /// Turns on the light of the shot and takes the image.
  /// @param z_mm  depth of the simulated target; ignored by a rig, whose target the user places
  /// @return  in the format of GuidedCalibration::take
  /// @errors  As start; kCancelled.
  [[nodiscard]] virtual Result<cv::Mat> take(calibration::ShotKind kind, double z_mm,
                                             const Progress& progress) = 0;

  /// One exposure of what the camera of such a shot sees now; helps the user to place the target.
  /// @errors  As take.
  [[nodiscard]] virtual Result<cv::Mat> look(calibration::ShotKind kind, double z_mm,
                                             const Progress& progress) = 0;

  /// From now on the virtual sensor sees the dotted board there, in place of plane and dots. A rig
  /// sees what the user holds.
  virtual void hold_board(const Isometry& /*T_sensor_board*/) {}

  /// Whether it can take kDotsTexture. Otherwise it has no flash: kDots needs a lamp.
  [[nodiscard]] virtual bool has_texture() const { return true; }

  /// Name shown to the user.
  [[nodiscard]] virtual std::string name() const = 0;

 protected:
  ShotSource() = default;
};

}  // namespace flytri::shots
