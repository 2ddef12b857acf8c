/// @file  A sensor with a closed-form model that draws calibration images, without polynomials.
#pragma once

#include <cmath>
#include <opencv2/core.hpp>

#include "core/calibration/record/calibration_set.h"
#include "core/imaging/frame.h"

namespace flytri::testing {

/// A pinhole camera, a little rolled and with barrel distortion; a projector beside it for the
/// vertical lines and one above it for the horizontal lines. The line width increases with z.
struct AnalyticSensor {
  Vec3 volume_mm{18.0, 13.0, 10.0};
  std::array<int, 2> line_counts{6, 4};
  ImageSize size{420, 320};
  double focal_px = 1150.0;
  double distance_mm = 55.0;  ///< camera to the origin
  double roll_rad = 0.02;
  double distortion = -0.15;     ///< coefficient of the squared tangent of the view angle
  double projector_mm = 8.0;     ///< distance of the projectors from the camera
  double line_spacing_mm = 2.9;  ///< at z = 0
  double turn_rad = 0.0;         ///< rotation of the projectors across their lines
  double focus_mm = -6.0;  ///< in front of the volume, so that lines widen through the whole volume
  double read_noise = 0.5;

  /// Image position of a point of the sensor frame.
  [[nodiscard]] Pixel project(const Vec3& p_sensor) const;
  /// The point of the plane z = z_mm that a pixel sees.
  [[nodiscard]] Vec3 back_project(const Pixel& pixel, double z_mm) const;
  /// x (vertical pattern) or y (horizontal) of line n on the plane z = z_mm.
  [[nodiscard]] double line_mm(Pattern pattern, int n, double z_mm) const;
  /// Where line n crosses the row or column `along_px` while the surface is at z_mm.
  [[nodiscard]] double across_px(Pattern pattern, int n, double along_px, double z_mm) const;
  /// Standard deviation of the imaged line.
  [[nodiscard]] double line_sigma_px(double z_mm) const {
    return std::hypot(1.2, 0.18 * (z_mm - focus_mm));
  }
};

/// Image of the plane z = z_mm under one line pattern.
[[nodiscard]] cv::Mat draw_lines(const AnalyticSensor& sensor, Pattern pattern, double z_mm,
                                 std::uint64_t seed);
/// Image of the dot target at z = z_mm.
[[nodiscard]] cv::Mat draw_dots(const AnalyticSensor& sensor, const calibration::DotTarget& dots,
                                double z_mm);
/// A complete calibration set. The texture camera is the same camera in color. Image names are
/// "z0_v.png" and so on.
[[nodiscard]] calibration::CalibrationSet draw_set(const AnalyticSensor& sensor, int plane_count);

}  // namespace flytri::testing
