#include "core/calibration/fit/calibrate.h"

#include "core/base/check_options.h"
#include "core/calibration/fit/check_set.h"
#include "core/calibration/fit/fit_flash.h"
#include "core/calibration/fit/fit_lateral.h"
#include "core/calibration/fit/number_lines.h"
#include "core/calibration/fit/residual_limits.h"

namespace flytri::calibration {
namespace {

Result<PatternCalibration> fit_pattern(const CalibrationSet& set, Pattern pattern,
                                       const CalibrateOptions& options, const Workers& workers) {
  const auto lines = number_lines(set, pattern, options.localize, workers);
  if (!lines) return tl::unexpected(lines.error());
  const cv::Mat& image = set.planes.front().vertical;
  return fit_lines(*lines, pattern, set.volume, {image.cols, image.rows}, options.lines);
}

/// Whether lines are dense shows in their areas, or in that they are not found as usual.
Result<PatternCalibration> calibrate_pattern(const CalibrationSet& set, Pattern pattern,
                                             const CalibrateOptions& options,
                                             const Workers& workers) {
  auto usual = fit_pattern(set, pattern, options, workers);
  if (usual && !usual->has_shared_areas()) return usual;
  CalibrateOptions dense_options = options;
  dense_options.localize = for_dense_lines(options.localize);
  auto dense = fit_pattern(set, pattern, dense_options, workers);
  return dense && dense->has_shared_areas() ? dense : usual;
}

}  // namespace

Result<void> CalibrateOptions::validate() const {
  return OptionCheck("CalibrateOptions")
      .nested(localize)
      .nested(lines)
      .positive("max_residual_share", max_residual_share)
      .positive("max_texture_residual_share", max_texture_residual_share)
      .result();
}

Result<Calibration> calibrate(const CalibrationSet& set, const CalibrateOptions& options,
                              const Workers& workers, const Progress& progress) {
  if (const auto valid = options.validate(); !valid) return tl::unexpected(valid.error());
  if (const auto checked = check_set(set); !checked) return tl::unexpected(checked.error());
  progress.begin_stage("calibrating", 3);
  const CalibrationPlane& first = set.planes.front();
  Calibration calibration;
  calibration.volume = set.volume;
  calibration.measurement_size = {first.vertical.cols, first.vertical.rows};
  calibration.texture_size = {first.dots_texture.cols, first.dots_texture.rows};

  const auto lateral = fit_lateral(set, workers);
  if (!lateral) return tl::unexpected(lateral.error());
  calibration.x_mm = lateral->x_mm;
  calibration.y_mm = lateral->y_mm;
  calibration.texture_u_px = lateral->texture_u_px;
  calibration.texture_v_px = lateral->texture_v_px;
  if (set.has_texture())
    calibration.flash = fit_flash(set, lateral->texture_u_px, lateral->texture_v_px, workers);
  progress.advance();

  for (const Pattern pattern : kPatterns) {
    if (progress.cancelled()) return fail(ErrorCode::kCancelled, "the calibration was stopped");
    auto lines = calibrate_pattern(set, pattern, options, workers);
    if (!lines) return tl::unexpected(lines.error());
    calibration.of(pattern) = std::move(*lines);
    calibration.of(pattern).sheet_normals = sheet_normals(calibration, pattern);
    progress.advance();
  }
  if (const auto good = check_residuals(calibration, options); !good) {
    return tl::unexpected(good.error());
  }
  return calibration;
}

}  // namespace flytri::calibration
