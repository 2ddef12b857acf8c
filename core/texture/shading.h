/// @file  How the lamp of the texture frames lights the surface.
#pragma once

#include "core/calibration/record/calibration.h"

namespace flytri::texture {

/// The lamp and the eye of the texture camera. With the lamp's light taken out of a pixel, the
/// color of the surface is left.
class Shading {
 public:
  /// Without a calibrated flash, the lamp is taken to be at the texture camera, and a surface that
  /// faces it in the middle of the volume to show its own brightness.
  explicit Shading(const calibration::Calibration& calibration);

  /// Directions to the lamp and the camera, and the light that arrives.
  struct Incidence {
    double lamp_cosine = 0.0;  ///< between the normal and the direction to the lamp
    double eye_cosine = 0.0;   ///< between the normal and the direction to the texture camera
    double light = 0.0;        ///< in the image, of a surface that faces the lamp and is white
  };
  /// @param rho2  square of the distance from the image's middle by half its diagonal
  [[nodiscard]] Incidence incidence(const Vec3& p_sensor, const Vec3& normal, double rho2) const;

  /// Distance from the texture camera, for comparisons along a ray of sight.
  [[nodiscard]] double depth_mm(const Vec3& p_sensor) const {
    return (p_sensor - eye_mm_).norm() - eye_mm_.norm();
  }
  /// Color of the lamp, by which the colors are divided.
  [[nodiscard]] const Vec3f& channels() const { return channels_; }

 private:
  Vec3 eye_mm_ = Vec3::Zero();   ///< where the rays of sight meet, in the sensor frame
  Vec3 lamp_mm_ = Vec3::Zero();  ///< in the sensor frame
  Vec3f channels_ = Vec3f::Ones();
  double strength_mm2_ = 1.0;  ///< light times the square of the distance
  double vignetting_ = 0.0;
};

/// Where the rays of sight of the texture camera meet, in the sensor frame. Far away if they are
/// parallel.
[[nodiscard]] Vec3 texture_eye(const calibration::Calibration& calibration);

}  // namespace flytri::texture
