#include "core/calibration/fit/residual_limits.h"

namespace flytri::calibration {
namespace {

Result<void> check_residual(const char* name, double rms, double limit, const char* unit) {
  if (rms <= limit) return {};
  return fail(ErrorCode::kInconsistent,
              "the fit of {} has an RMS residual of {:.4f} {}, more than {:.4f}; check that the "
              "depths of the planes are right and all images come from one sensor",
              name, rms, unit, limit);
}

}  // namespace

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

}  // namespace flytri::calibration
