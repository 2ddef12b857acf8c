#include "core/calibration/fit/fit_lateral.h"

#include "core/calibration/fit/find_dots.h"
#include "core/calibration/fit/least_squares.h"
#include "core/calibration/fit/number_dots.h"

namespace flytri::calibration {
namespace {

Result<std::vector<PlacedDot>> dots_of(const cv::Mat& image, const std::string& name, double z_mm,
                                       const DotTarget& target) {
  const auto numbered = number_dots(find_dots(linear_gray(image)), target);
  if (!numbered) return fail(numbered.error().code, "{}: {}", name, numbered.error().message);
  std::vector<PlacedDot> dots;
  for (const NumberedDot& dot : *numbered) {
    dots.push_back({{dot.i * target.pitch_mm, dot.j * target.pitch_mm, z_mm}, dot.center});
  }
  return dots;
}

/// The dots of all planes in the images of one camera.
Result<std::vector<PlacedDot>> all_dots(const CalibrationSet& set, bool texture,
                                        const Workers& workers) {
  std::vector<Result<std::vector<PlacedDot>>> parts(set.planes.size());
  workers.for_each(set.planes.size(), [&](std::size_t i) {
    const CalibrationPlane& plane = set.planes[i];
    parts[i] = texture ? dots_of(plane.dots_texture, plane.dots_texture_name, plane.z_mm, set.dots)
                       : dots_of(plane.dots, plane.dots_name, plane.z_mm, set.dots);
  });
  std::vector<PlacedDot> dots;
  for (const auto& part : parts) {
    if (!part) return tl::unexpected(part.error());
    dots.insert(dots.end(), part->begin(), part->end());
  }
  return dots;
}

Result<TrivariateCubic> fit_named(const std::vector<CubicDatum>& data, const char* name) {
  auto cubic = fit_cubic(data);
  if (!cubic) return fail(cubic.error().code, "fit of {}: {}", name, cubic.error().message);
  return cubic;
}

Result<void> fit_measurement_camera(const std::vector<PlacedDot>& dots,
                                    LateralCalibration& lateral) {
  std::vector<CubicDatum> x, y;
  for (const PlacedDot& dot : dots) {
    const Vec3 uvz(dot.center.u_px, dot.center.v_px, dot.p_sensor.z());
    x.push_back({uvz, dot.p_sensor.x()});
    y.push_back({uvz, dot.p_sensor.y()});
  }
  const auto x_mm = fit_named(x, "X");
  if (!x_mm) return tl::unexpected(x_mm.error());
  const auto y_mm = fit_named(y, "Y");
  if (!y_mm) return tl::unexpected(y_mm.error());
  lateral.x_mm = *x_mm;
  lateral.y_mm = *y_mm;
  return {};
}

Result<void> fit_texture_camera(const std::vector<PlacedDot>& dots, LateralCalibration& lateral) {
  std::vector<CubicDatum> u, v;
  for (const PlacedDot& dot : dots) {
    u.push_back({dot.p_sensor, dot.center.u_px});
    v.push_back({dot.p_sensor, dot.center.v_px});
  }
  const auto u_px = fit_named(u, "U");
  if (!u_px) return tl::unexpected(u_px.error());
  const auto v_px = fit_named(v, "V");
  if (!v_px) return tl::unexpected(v_px.error());
  lateral.texture_u_px = *u_px;
  lateral.texture_v_px = *v_px;
  return {};
}

}  // namespace

Result<LateralCalibration> fit_lateral(const std::vector<PlacedDot>& dots,
                                       const std::vector<PlacedDot>& texture_dots) {
  LateralCalibration lateral;
  return fit_measurement_camera(dots, lateral)
      .and_then([&]() -> Result<void> {
        if (texture_dots.empty()) return {};
        return fit_texture_camera(texture_dots, lateral);
      })
      .map([&] { return lateral; });
}

Result<LateralCalibration> fit_lateral(const CalibrationSet& set, const Workers& workers) {
  const auto dots = all_dots(set, false, workers);
  if (!dots) return tl::unexpected(dots.error());
  if (!set.has_texture()) return fit_lateral(*dots, {});
  const auto texture_dots = all_dots(set, true, workers);
  if (!texture_dots) return tl::unexpected(texture_dots.error());
  return fit_lateral(*dots, *texture_dots);
}

}  // namespace flytri::calibration
