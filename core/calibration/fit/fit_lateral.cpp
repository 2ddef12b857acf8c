#include "core/calibration/fit/fit_lateral.h"

#include "core/calibration/fit/find_dots.h"
#include "core/calibration/fit/least_squares.h"
#include "core/calibration/fit/number_dots.h"

namespace flytri::calibration {
namespace {

/// A dot with its position in the sensor frame and in the image.
struct PlacedDot {
  Vec3 p_sensor;  ///< mm
  Pixel center;
};

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

}  // namespace

Result<LateralCalibration> fit_lateral(const CalibrationSet& set, const Workers& workers) {
  const auto measured = all_dots(set, false, workers);
  if (!measured) return tl::unexpected(measured.error());
  const auto textured = all_dots(set, true, workers);
  if (!textured) return tl::unexpected(textured.error());

  std::vector<CubicDatum> x, y, u, v;
  for (const PlacedDot& dot : *measured) {
    const Vec3 uvz(dot.center.u_px, dot.center.v_px, dot.p_sensor.z());
    x.push_back({uvz, dot.p_sensor.x()});
    y.push_back({uvz, dot.p_sensor.y()});
  }
  for (const PlacedDot& dot : *textured) {
    u.push_back({dot.p_sensor, dot.center.u_px});
    v.push_back({dot.p_sensor, dot.center.v_px});
  }
  const auto x_mm = fit_named(x, "X");
  if (!x_mm) return tl::unexpected(x_mm.error());
  const auto y_mm = fit_named(y, "Y");
  if (!y_mm) return tl::unexpected(y_mm.error());
  const auto u_px = fit_named(u, "U");
  if (!u_px) return tl::unexpected(u_px.error());
  const auto v_px = fit_named(v, "V");
  if (!v_px) return tl::unexpected(v_px.error());
  return LateralCalibration{*x_mm, *y_mm, *u_px, *v_px};
}

}  // namespace flytri::calibration
