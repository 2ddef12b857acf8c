/// @file  Measures the distance of each calibration plane from its stated depth, with the fitted
///          calibration.
#pragma once

#include <array>
#include <vector>

#include "core/base/workers.h"
#include "core/calibration/fit/number_lines.h"
#include "core/calibration/record/calibration_set.h"
#include "core/localization/localize.h"

namespace flytri::calibration {

/// Residuals of one plane.
struct PlaneResidual {
  double z_mm = 0.0;                    ///< of the plane, if it is not tilted
  std::array<double, 2> offset_mm{};    ///< by Pattern: mean measured depth minus the true one
  std::array<double, 2> rms_mm{};       ///< by Pattern: standard deviation of single samples
  std::array<std::int64_t, 2> count{};  ///< by Pattern: number of samples; 0: no line in the image
};

/// When a plane does not fit the others.
struct PlaneResidualOptions {
  /// > 0. Largest offset of a plane as a share of the volume's depth. A misplaced plane also
  /// changes the fit, so its offset shows only a part of its error.
  double max_offset_share = 0.001;
  [[nodiscard]] Result<void> validate() const;
};

/// Adds what one pattern shows of each plane.
/// @param planes  by the number of the plane
void add_residuals(const NumberedLines& lines, const PatternCalibration& calibration,
                   Pattern pattern, std::vector<PlaneResidual>& planes);

/// @param calibration  fitted to this set
/// @errors  As number_lines.
[[nodiscard]] Result<std::vector<PlaneResidual>> plane_residuals(
    const CalibrationSet& set, const Calibration& calibration,
    const localization::LocalizeOptions& options, const Workers& workers);

/// @errors  kInconsistent: names the worst plane, and whether it was at a wrong depth or moved
///          between its shots.
[[nodiscard]] Result<void> check_plane_residuals(const std::vector<PlaneResidual>& planes,
                                                 const MeasurementVolume& volume,
                                                 const PlaneResidualOptions& options);

}  // namespace flytri::calibration
