/// @file  The depth, width and unique area of every line in every row, from numbered lines.
#pragma once

#include "core/calibration/fit/number_lines.h"

namespace flytri::calibration {

/// How the per-row polynomials are stabilized.
struct LineFitOptions {
  /// 0..8. Degree along the line of each coefficient of Z: optics are smooth, so neighboring rows
  /// share what they know. A row alone has as many data as there are planes.
  int depth_along_degree = 5;
  /// 0..8. The same for the width, which changes less.
  int width_along_degree = 2;

  [[nodiscard]] Result<void> validate() const;
};

/// Fits Z and the width of each line and cuts its unique area: where the line is while the surface
/// is inside the depth of the volume.
/// @param image_size  of the measurement camera.
/// @source  Arold et al., "z-Calibration" and "Line Indexing"; fitted to all rows of a line at
///          once, with coefficients that are polynomials of the row.
/// @errors  kInsufficient or kInconsistent, naming pattern and line.
[[nodiscard]] Result<PatternCalibration> fit_lines(const NumberedLines& lines, Pattern pattern,
                                                   const MeasurementVolume& volume,
                                                   ImageSize image_size,
                                                   const LineFitOptions& options);

/// Unit normal of the best plane through each line's light sheet.
[[nodiscard]] std::vector<Vec3> sheet_normals(const Calibration& calibration, Pattern pattern);

}  // namespace flytri::calibration
