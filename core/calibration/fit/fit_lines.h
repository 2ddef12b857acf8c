/// @file  Fits depth, width and unique area of every line in every row.
#pragma once

#include "core/calibration/fit/number_lines.h"

namespace flytri::calibration {

/// Degrees of the polynomials along a line.
struct LineFitOptions {
  /// 0..8. Degree along the line of each coefficient of Z. Optics are smooth, so neighboring rows
  /// are fitted together: a single row has only one datum per plane.
  int depth_along_degree = 5;
  /// 0..8. Degree for the width, which changes less.
  int width_along_degree = 2;

  [[nodiscard]] Result<void> validate() const;
};

/// Fits Z and the width of each line and computes its unique area: the positions of the line while
/// the surface is inside the depth of the volume.
/// @param image_size  of the measurement camera.
/// @source  Arold et al., "z-Calibration" and "Line Indexing"; here all rows of a line are fitted
///          together, and the coefficients are polynomials of the row.
/// @errors  kInsufficient or kInconsistent, naming pattern and line.
[[nodiscard]] Result<PatternCalibration> fit_lines(const NumberedLines& lines, Pattern pattern,
                                                   const MeasurementVolume& volume,
                                                   ImageSize image_size,
                                                   const LineFitOptions& options);

/// Unit normal of the best plane through each line's light sheet.
[[nodiscard]] std::vector<Vec3> sheet_normals(const Calibration& calibration, Pattern pattern);

}  // namespace flytri::calibration
