#include "hw/simulated/optics/sensor_model.h"

#include <cmath>

#include "core/base/check_options.h"

namespace flytri::simulated {

double ThinLens::blur_radius_mm(double distance_mm) const {
  return aperture_radius_mm * std::abs(distance_mm - focus_mm) / focus_mm;
}

Vec2 LensDistortion::distort(const Vec2& ideal) const {
  const double x = ideal.x();
  const double y = ideal.y();
  const double r2 = x * x + y * y;
  const double radial = 1.0 + r2 * (k1 + r2 * k2);
  return {x * radial + 2.0 * p1 * x * y + p2 * (r2 + 2.0 * x * x),
          y * radial + p1 * (r2 + 2.0 * y * y) + 2.0 * p2 * x * y};
}

Vec2 LensDistortion::undistort(const Vec2& distorted) const {
  // Newton's method converges quadratically: after a step this small, the result is exact.
  constexpr int kMaxSteps = 8;
  constexpr double kExactEnough = 1e-7;
  Vec2 ideal = distorted;
  for (int step = 0; step < kMaxSteps; ++step) {
    const double x = ideal.x();
    const double y = ideal.y();
    const double r2 = x * x + y * y;
    const double radial = 1.0 + r2 * (k1 + r2 * k2);
    const double slope = 2.0 * k1 + 4.0 * k2 * r2;  // of radial, by x or y each
    const double mixed = slope * x * y + 2.0 * (p1 * x + p2 * y);
    const double xx = radial + slope * x * x + 2.0 * p1 * y + 6.0 * p2 * x;
    const double yy = radial + slope * y * y + 6.0 * p1 * y + 2.0 * p2 * x;
    const Vec2 rest = distorted - distort(ideal);
    const double determinant = xx * yy - mixed * mixed;
    const Vec2 correction((yy * rest.x() - mixed * rest.y()) / determinant,
                          (xx * rest.y() - mixed * rest.x()) / determinant);
    ideal += correction;
    if (correction.cwiseAbs().maxCoeff() < kExactEnough) break;
  }
  return ideal;
}

std::optional<Pixel> CameraModel::project(const Vec3& p_sensor) const {
  const Vec3 p_camera = T_sensor_camera.linear().transpose() * (p_sensor - center());
  if (p_camera.z() <= 0.0) return std::nullopt;
  const Vec2 place =
      focal_px * distortion.distort(p_camera.head<2>() / p_camera.z()) + principal_px;
  return Pixel{place.x(), place.y()};
}

Vec3 CameraModel::direction(const Pixel& pixel) const {
  const Vec2 distorted = (Vec2(pixel.u_px, pixel.v_px) - principal_px) / focal_px;
  return T_sensor_camera.linear() * distortion.undistort(distorted).homogeneous().normalized();
}

bool CameraModel::sees(const Pixel& pixel) const {
  return pixel.u_px >= -0.5 && pixel.u_px < size.width_px - 0.5 && pixel.v_px >= -0.5 &&
         pixel.v_px < size.height_px - 0.5;
}

std::vector<Vec3> CameraModel::pixel_directions() const {
  std::vector<Vec3> directions;
  directions.reserve(static_cast<std::size_t>(size.width_px) * size.height_px);
  for (int v = 0; v < size.height_px; ++v)
    for (int u = 0; u < size.width_px; ++u)
      directions.push_back(direction({static_cast<double>(u), static_cast<double>(v)}));
  return directions;
}

Vec3 ProjectorModel::direction(double across, double along) const {
  return T_sensor_projector.linear() * distortion.distort({across, along}).homogeneous();
}

std::optional<Vec2> ProjectorModel::slide_place(const Vec3& p_sensor) const {
  const Vec3 p_projector = T_sensor_projector.linear().transpose() * (p_sensor - center());
  if (p_projector.z() <= 0.0) return std::nullopt;
  return distortion.undistort(p_projector.head<2>() / p_projector.z());
}

Vec3 ProjectorModel::sheet_normal(LineIndex n) const {
  const double across = line_across[n.at()];
  return direction(across, half_length_along)
      .cross(direction(across, -half_length_along))
      .normalized();
}

namespace {

void check_lens(const ThinLens& lens, const std::string& owner, OptionCheck& check) {
  check.positive(owner + ".lens.focus_mm", lens.focus_mm)
      .not_negative(owner + ".lens.aperture_radius_mm", lens.aperture_radius_mm);
}

void check_camera(const CameraModel& camera, const std::string& name, OptionCheck& check) {
  check.at_least(name + ".size.width_px", camera.size.width_px, 1)
      .at_least(name + ".size.height_px", camera.size.height_px, 1)
      .positive(name + ".focal_px", camera.focal_px);
  check_lens(camera.lens, name, check);
}

void check_projector(const ProjectorModel& projector, Pattern pattern, OptionCheck& check) {
  const std::string name = fmt::format("projector({})", to_string(pattern));
  check.must(name + ".pattern", to_string(projector.pattern), projector.pattern == pattern,
             to_string(pattern))
      .at_least(name + ".line_count", projector.line_count(), 1);
  check_lens(projector.lens, name, check);
}

}  // namespace

Result<void> SensorModel::validate() const {
  OptionCheck check("SensorModel");
  check.positive("volume.size_mm", volume.size_mm.minCoeff());
  check_camera(camera, "camera", check);
  check_camera(texture_camera, "texture_camera", check);
  for (const Pattern pattern : kPatterns) check_projector(projector(pattern), pattern, check);
  return check.positive("chip.full_well_e", chip.full_well_e)
      .positive("chip.line_level", chip.line_level)
      .positive("chip.speckle_size_px", chip.speckle_size_px)
      .positive("exposure_s", exposure_s)
      .must("frame_period_s", frame_period_s, frame_period_s >= exposure_s, "at least exposure_s")
      .result();
}

}  // namespace flytri::simulated
