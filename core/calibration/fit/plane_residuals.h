/// @file  How far a fitted calibration puts each plane of its set from where the set says it was.
#pragma once

#include <array>
#include <vector>

#include "core/base/workers.h"
#include "core/calibration/record/calibration_set.h"
#include "core/localization/localize.h"

namespace flytri::calibration {

/// One plane as one calibration sees it.
struct PlaneResidual {
  double z_mm = 0.0;
  std::array<double, 2> offset_mm{};    ///< by Pattern: mean depth of its lines, less z_mm
  std::array<double, 2> rms_mm{};       ///< by Pattern: of single samples about that mean
  std::array<std::int64_t, 2> count{};  ///< by Pattern: samples; 0: the lines have left the image
};

/// When a plane does not fit the others.
struct PlaneResidualOptions {
  /// > 0. Largest offset of a plane as a share of the volume's depth. A plane that was misplaced
  /// pulls the fit to itself and shows a part of its error only.
  double max_offset_share = 0.001;
  [[nodiscard]] Result<void> validate() const;
};

/// @param calibration  fitted to this set
/// @errors  As number_lines.
[[nodiscard]] Result<std::vector<PlaneResidual>> plane_residuals(
    const CalibrationSet& set, const Calibration& calibration,
    const localization::LocalizeOptions& options, const Workers& workers);

/// @errors  kInconsistent: the worst plane, and whether it stood wrong or moved between its shots.
[[nodiscard]] Result<void> check_plane_residuals(const std::vector<PlaneResidual>& planes,
                                                 const MeasurementVolume& volume,
                                                 const PlaneResidualOptions& options);

}  // namespace flytri::calibration
