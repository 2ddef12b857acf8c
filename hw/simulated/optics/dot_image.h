/// @file  Simulates the image of the dot target.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "hw/simulated/optics/sensor_model.h"

namespace flytri::simulated {

/// A camera in front of the target: bright dots on black, evenly lit. Immutable.
class DotImage {
 public:
  DotImage(const CameraModel& camera, const calibration::DotTarget& target);

  /// The image of the target at z = `z_mm`, moved aside by `aside_mm`.
  /// @return  CV_32FC1, share of full scale, without noise
  [[nodiscard]] cv::Mat light(double z_mm, const Vec2& aside_mm = Vec2::Zero()) const;

 private:
  [[nodiscard]] std::vector<Vec2> places_on_plane(double z_mm, const Vec2& aside_mm) const;
  [[nodiscard]] double bright_share(const Vec2& place, const Vec2& right, const Vec2& down) const;

  CameraModel camera_;
  calibration::DotTarget target_;
  std::vector<Vec3> directions_;  // by pixel
};

}  // namespace flytri::simulated
