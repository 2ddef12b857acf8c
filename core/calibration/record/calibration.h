/// @file  The calibration record of a sensor: from image positions to millimeters, without a model
///          of lens or projector.
///
/// @source  Arold et al., "z-Calibration", "xy-Calibration", "Inverse Lateral Calibration",
///          "Line Indexing" (unique areas and normalized width).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/index.h"
#include "core/base/result.h"
#include "core/calibration/record/calibration_history.h"
#include "core/geometry/rigid.h"
#include "core/imaging/frame.h"
#include "core/imaging/pattern.h"

namespace flytri::calibration {

/// Extent of the measurement volume, centered at the origin of the sensor frame.
struct MeasurementVolume {
  Vec3 size_mm = Vec3::Zero();
  /// True if the point is inside the volume enlarged by `margin_mm` on every side.
  [[nodiscard]] bool contains(const Vec3& p_sensor, double margin_mm = 0.0) const {
    return ((p_sensor.cwiseAbs() - 0.5 * size_mm).array() <= margin_mm).all();
  }
};

/// Residual of a fit.
struct FitResidual {
  double rms = 0.0;
  double max = 0.0;
  std::int64_t count = 0;  ///< data points used
};

/// A polynomial in one variable, fitted in the normalized variable t = (x - center) / half_range.
template <int kTerms>
struct Polynomial {
  double center = 0.0;
  double half_range = 1.0;
  std::array<double, kTerms> coefficients{};  ///< of t^0, t^1, ...

  [[nodiscard]] double operator()(double x) const {
    const double t = (x - center) / half_range;
    double value = 0.0;
    for (int i = kTerms - 1; i >= 0; --i) value = value * t + coefficients[i];
    return value;
  }
  [[nodiscard]] double derivative(double x) const {
    const double t = (x - center) / half_range;
    double value = 0.0;
    for (int i = kTerms - 1; i >= 1; --i) value = value * t + i * coefficients[i];
    return value / half_range;
  }
};

/// A full cubic in three variables, 20 terms, each variable normalized to about -1..1.
/// Terms a^i b^j c^k with i + j + k <= 3, in the order of `kExponents`.
struct TrivariateCubic {
  static constexpr int kTerms = 20;
  static const std::array<std::array<int, 3>, kTerms> kExponents;

  Vec3 center = Vec3::Zero();
  Vec3 half_range = Vec3::Ones();
  std::array<double, kTerms> coefficients{};
  FitResidual residual;

  [[nodiscard]] double operator()(const Vec3& x) const;
  [[nodiscard]] Vec3 gradient(const Vec3& x) const;
};

/// One line n at one image row v (vertical pattern) or column u (horizontal pattern).
/// `across` is u for the vertical, v for the horizontal pattern.
struct LineRow {
  Polynomial<4> depth_mm;   ///< Z: across -> z; paper, section "z-Calibration"
  Polynomial<3> width_px;   ///< across -> full width at half maximum of the line
  double area_min_px = 0;   ///< area: smallest `across` of this line inside the volume; unique
                            ///< unless the lines are dense
  double area_max_px = -1;  ///< largest `across`; below area_min_px: the line is not calibrated in
                            ///< this row
  [[nodiscard]] bool valid() const { return area_max_px >= area_min_px; }
};

/// All lines of one pattern: lines[n][along].
struct PatternCalibration {
  std::vector<std::vector<LineRow>> lines;
  std::vector<Vec3> sheet_normals;  ///< per line, unit normal of the best plane through its sheet
  FitResidual depth_residual_mm;
  FitResidual width_residual_px;

  [[nodiscard]] int line_count() const { return static_cast<int>(lines.size()); }
  /// True if a position in the image can be of several lines: their areas overlap.
  [[nodiscard]] bool has_shared_areas() const;
};

/// The lamp of the texture frames. It is small. A matte surface reflects the share `albedo` of its
/// light. In the texture image it has this brightness (linear, 0..1):
///
///     albedo * light * cos(incidence) * (kFlashDistance_mm / distance)^2 * (1 - vignetting rho^2)
///
/// where rho is the distance from the middle of the image, divided by half its diagonal.
struct Flash {
  static constexpr double kFlashDistance_mm = 100.0;

  Vec3 p_sensor_mm = Vec3::Zero();  ///< place of the lamp
  Vec3 light = Vec3::Ones();        ///< red, green and blue, with the camera's white balance
  double vignetting = 0.0;
  FitResidual residual;  ///< relative
};

/// Converts localized lines to points, and points to texture pixels.
struct Calibration {
  MeasurementVolume volume;
  ImageSize measurement_size;
  ImageSize texture_size;                      ///< 0 x 0: the sensor has no texture camera
  std::array<PatternCalibration, 2> patterns;  ///< by Pattern
  TrivariateCubic x_mm, y_mm;                  ///< (u, v, z) -> x, y
  TrivariateCubic texture_u_px, texture_v_px;  ///< (x, y, z) -> U, V in the texture image, if any
  std::optional<Flash> flash;                  ///< none: not calibrated
  CalibrationHistory history;                  ///< does not change what it measures

  [[nodiscard]] bool has_texture() const { return texture_size.width_px > 0; }
  [[nodiscard]] const PatternCalibration& of(Pattern pattern) const {
    return patterns[static_cast<std::size_t>(pattern)];
  }
  [[nodiscard]] PatternCalibration& of(Pattern pattern) {
    return patterns[static_cast<std::size_t>(pattern)];
  }
  /// Sensor-frame position of line n seen at `pixel`. The row must be valid.
  [[nodiscard]] Vec3 locate(Pattern pattern, LineIndex n, const LinePixel& pixel) const;
  /// Where the rays of the measurement camera meet, sensor frame; none if they are parallel.
  [[nodiscard]] std::optional<Vec3> camera_center_mm() const;
  /// Position of a point in the image of the measurement camera; may be outside the image.
  [[nodiscard]] Pixel project_to_measurement(const Vec3& p_sensor) const;
  /// Position of a point in the texture image; may be outside the image.
  [[nodiscard]] Pixel project_to_texture(const Vec3& p_sensor) const;
};

}  // namespace flytri::calibration
