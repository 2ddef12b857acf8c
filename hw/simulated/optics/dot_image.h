/// @file  Simulates the image of a target with dots.
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "core/geometry/rigid.h"
#include "hw/simulated/optics/sensor_model.h"

namespace flytri::simulated {

/// How bright a target is, as a share of full scale. Default: bright dots on black, evenly lit.
struct DotLook {
  double dot_level = 0.7;
  double background_level = 0.02;
  /// A small lamp there lights the target, which is that bright in the middle of the volume.
  std::optional<Vec3> lamp_mm;
};

/// A camera in front of the target. Immutable.
class DotImage {
 public:
  DotImage(const CameraModel& camera, const calibration::DotTarget& target,
           const DotLook& look = {});

  /// @param T_sensor_target  the dots are in its plane z = 0, dot (0, 0) at its origin
  /// @return  CV_32FC1, share of full scale, without noise
  [[nodiscard]] cv::Mat light(const Isometry& T_sensor_target) const;

 private:
  struct Seen;
  [[nodiscard]] Seen seen_of(const Isometry& T_sensor_target) const;
  [[nodiscard]] double dot_share(const Vec2& place, const Vec2& right, const Vec2& down) const;
  [[nodiscard]] double shading(const Vec3& p_sensor, const Vec3& normal) const;
  [[nodiscard]] cv::Mat blurred(const cv::Mat& light, const Seen& seen) const;

  CameraModel camera_;
  calibration::DotTarget target_;
  DotLook look_;
  std::vector<Vec3> directions_;  // by pixel
};

}  // namespace flytri::simulated
