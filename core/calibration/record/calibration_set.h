/// @file  The images of a calibration set in memory.
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "core/calibration/record/calibration.h"

namespace flytri::calibration {

/// The square grid of bright dots: dot (i, j) at x = i * pitch, y = j * pitch; the dots (0, 0),
/// (1, 0) and (0, 2) are larger.
struct DotTarget {
  double pitch_mm = 0.0;
  double diameter_mm = 0.0;
  double marker_diameter_mm = 0.0;

  [[nodiscard]] double diameter_of(int i, int j) const {
    const bool is_marker = (j == 0 && (i == 0 || i == 1)) || (i == 0 && j == 2);
    return is_marker ? marker_diameter_mm : diameter_mm;
  }
};

/// The images of the plane z = z_mm with each light. Names are for messages.
struct CalibrationPlane {
  double z_mm = 0.0;
  cv::Mat vertical, horizontal;  ///< CV_8UC1 or CV_16UC1, linear in light
  cv::Mat dots;                  ///< measurement camera, CV_8UC1 or CV_16UC1
  cv::Mat dots_texture;  ///< texture camera, CV_8UC3 in R, G, B order, sRGB; empty: there is none
  std::string vertical_name, horizontal_name, dots_name, dots_texture_name;
};

/// What a set of calibration images tells beside its images.
struct CalibrationScene {
  MeasurementVolume volume;
  std::array<int, 2> line_counts{};  ///< by Pattern
  DotTarget dots;
};

/// A calibration set, see docs/formats.md.
struct CalibrationSet : CalibrationScene {
  std::vector<CalibrationPlane> planes;  ///< by rising z

  /// Whether a texture camera took part: then in all planes.
  [[nodiscard]] bool has_texture() const {
    return !planes.empty() && !planes.front().dots_texture.empty();
  }
};

/// Sets the file names of the images of plane `index`: z00_v.png and so on.
void name_images(CalibrationPlane& plane, std::size_t index);

}  // namespace flytri::calibration
