/// @file  What a view would show of a place, if there were a surface.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <vector>

#include "core/calibration/record/calibration.h"
#include "core/geometry/view.h"

namespace flytri::live {

/// The line that would light a place, and where it would be in the image: the row, for the
/// horizontal pattern the column.
struct ExpectedLine {
  LineIndex line;
  int along_px = 0;
};

/// Which places the projected lines would light, in the sensor frame.
class ExpectedLight {
 public:
  /// @param calibration  must outlive this object
  explicit ExpectedLight(const calibration::Calibration& calibration);

  [[nodiscard]] const calibration::Calibration& calibration() const { return *calibration_; }
  [[nodiscard]] const std::optional<Vec3>& camera_center_mm() const { return camera_center_mm_; }
  /// Whether a surface is turned to the camera.
  /// @param min_cosine  between its normal and the ray
  [[nodiscard]] bool faces_camera(const Vec3& p_sensor, const Vec3& normal,
                                  double min_cosine) const;
  /// @param within_mm  > 0. Distance of the place from the light of a line that counts as lit
  /// @return  none: the place lies between lines, or where nothing is measured
  [[nodiscard]] std::optional<ExpectedLine> line_at(Pattern pattern, const Vec3& p_sensor,
                                                    double within_mm) const;

 private:
  /// Light of a line, nearly a plane: normal . p = offset_mm.
  struct Sheet {
    LineIndex line;
    Vec3 normal;
    double offset_mm = 0.0;
    double sag_mm = 0.0;  ///< farthest from the plane
  };
  [[nodiscard]] Vec3 ray_per_mm(const Vec3& p_sensor) const;

  const calibration::Calibration* calibration_;
  std::optional<Vec3> camera_center_mm_;
  std::array<std::vector<Sheet>, 2> sheets_;  ///< by Pattern
};

/// What one view saw: for each line, its depth in each image row or column.
class SeenLines {
 public:
  SeenLines(const View& view, const calibration::Calibration& calibration);
  [[nodiscard]] Pattern pattern() const { return pattern_; }
  /// Depth z, sensor frame, mm, of the line near this row or column; none: it was not seen.
  [[nodiscard]] std::optional<float> depth_mm(const ExpectedLine& expected) const;

 private:
  static constexpr float kNotSeen = std::numeric_limits<float>::infinity();
  Pattern pattern_;
  std::size_t rows_ = 0;
  std::vector<float> depths_mm_;  ///< line after line
};

}  // namespace flytri::live
