#include "core/calibration/fit/calibrate.h"

#include "core/base/check_options.h"
#include "core/calibration/fit/check_set.h"
#include "core/calibration/fit/fit_flash.h"
#include "core/calibration/fit/fit_lateral.h"
#include "core/calibration/fit/number_lines.h"

namespace flytri::calibration {
namespace {

Result<void> check_residual(const char* name, double rms, double limit, const char* unit) {
  if (rms <= limit) return {};
  return fail(ErrorCode::kInconsistent,
              "the fit of {} has an RMS residual of {:.4f} {}, more than {:.4f}; check that the "
              "depths of the planes are right and all images come from one sensor",
              name, rms, unit, limit);
}

Result<void> check_residuals(const Calibration& calibration, const CalibrateOptions& options) {
  const Vec3 limit_mm = options.max_residual_share * calibration.volume.size_mm;
  const double limit_px = options.max_texture_residual_share * calibration.texture_size.width_px;
  struct Check {
    const char* name;
    double rms, limit;
    const char* unit;
  };
  const Check checks[] = {
      {"Z of the vertical lines", calibration.of(Pattern::kVertical).depth_residual_mm.rms,
       limit_mm.z(), "mm"},
      {"Z of the horizontal lines", calibration.of(Pattern::kHorizontal).depth_residual_mm.rms,
       limit_mm.z(), "mm"},
      {"X", calibration.x_mm.residual.rms, limit_mm.x(), "mm"},
      {"Y", calibration.y_mm.residual.rms, limit_mm.y(), "mm"},
      {"U", calibration.texture_u_px.residual.rms, limit_px, "px"},
      {"V", calibration.texture_v_px.residual.rms, limit_px, "px"},
  };
  for (const Check& check : checks) {
    auto good = check_residual(check.name, check.rms, check.limit, check.unit);
    if (!good) return good;
  }
  return {};
}

Result<PatternCalibration> calibrate_pattern(const CalibrationSet& set, Pattern pattern,
                                             const CalibrateOptions& options,
                                             const Workers& workers) {
  const auto lines = number_lines(set, pattern, options.localize, workers);
  if (!lines) return tl::unexpected(lines.error());
  const cv::Mat& image = set.planes.front().vertical;
  return fit_lines(*lines, pattern, set.volume, {image.cols, image.rows}, options.lines);
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
