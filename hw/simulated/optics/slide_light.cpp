#include "hw/simulated/optics/slide_light.h"

#include <algorithm>
#include <cmath>

#include "hw/simulated/optics/room_light.h"

namespace flytri::simulated {
namespace {

// Lines are traced this far outside the volume; farther away their light is negligible.
constexpr double kDepthMargin = 1.0;  // by the volume's depth
constexpr int kPupilPoints = 7;
// Assumed largest movement of a line during an exposure.
constexpr double kMotion_px = 8.0;

double largest_blur(const ProjectorModel& projector, const SensorModel& sensor) {
  const double middle = projector.center().norm();
  const double farthest = middle + (0.5 + kDepthMargin) * sensor.volume.size_mm.z();
  return projector.lens.blur_radius_mm(farthest) / farthest;
}

}  // namespace

SlideLight::SlideLight(const SensorModel& sensor, Pattern pattern)
    : projector_(sensor.projector(pattern)),
      profile_(projector_, largest_blur(projector_, sensor)),
      R_projector_sensor_(projector_.T_sensor_projector.linear().transpose()),
      center_mm_(projector_.center()),
      focal_px_(sensor.camera.focal_px) {
  // The camera's blur lowers the peak: the squared widths of the Gaussians add up.
  const double middle_mm = projector_.center().norm();
  const double blur = projector_.lens.blur_radius_mm(middle_mm) / middle_mm;
  const double peak = profile_(0.0, blur);
  const double width_px = 2.0 * projector_.half_width_across / peak * sensor.camera.focal_px;
  const double camera_mm = sensor.camera.center().norm();
  const double camera_blur_px =
      sensor.camera.lens.blur_radius_mm(camera_mm) / camera_mm * sensor.camera.focal_px +
      2.0 * sensor.camera.diffraction_sigma_px;
  gain_ = sensor.chip.line_level / peak * std::hypot(width_px, camera_blur_px) / width_px;
}

std::optional<SlidePoint> SlideLight::point(const LineExposure& exposure, const Vec3& view,
                                            const RayHit& hit) const {
  const Eigen::Matrix3d R_sensor_model = exposure.T_model_sensor.linear().transpose();
  SlidePoint point;
  point.view = view;
  point.position_mm = R_sensor_model * (hit.point_mm - exposure.T_model_sensor.translation());
  point.normal = R_sensor_model * hit.normal;
  const double facing = -point.normal.dot(view);
  if (facing < kMinCosine) return std::nullopt;
  const auto place = projector_.slide_place(point.position_mm);
  if (!place || std::abs(place->y()) > projector_.half_length_along) return std::nullopt;
  point.p_projector = R_projector_sensor_ * (point.position_mm - center_mm_);
  point.across = place->x();
  point.blur = projector_.lens.blur_radius_mm(point.p_projector.z()) / point.p_projector.z();
  return point;
}

SlidePoint SlideLight::point(const Vec3& position_mm, const Vec3& normal, const Vec3& view,
                             double across, double blur) const {
  return {position_mm, normal, view, R_projector_sensor_ * (position_mm - center_mm_),
          across,      blur};
}

double SlideLight::from_nearest_line(double across) const {
  const auto& lines = projector_.line_across;
  const auto after = std::lower_bound(lines.begin(), lines.end(), across);
  if (after == lines.begin()) return across - lines.front();
  if (after == lines.end()) return across - lines.back();
  const double from_after = across - *after;
  const double from_before = across - *(after - 1);
  return -from_after < from_before ? from_after : from_before;
}

double SlideLight::reach(double blur) const {
  return profile_.reach(blur) + kMotion_px / focal_px_;
}

double SlideLight::shift(const SlidePoint& point, const Isometry& T_then_middle) const {
  // Movement of the place on the slide per mm along the ray.
  const Vec3 view_projector = R_projector_sensor_ * point.view;
  const double slope =
      (view_projector.x() - point.p_projector.x() / point.p_projector.z() * view_projector.z()) /
      point.p_projector.z();
  const Eigen::Matrix3d R_then_middle = T_then_middle.linear();
  const Vec3 moved = R_then_middle * point.position_mm + T_then_middle.translation();
  const Vec3 normal = R_then_middle * point.normal;
  const double shift_mm =
      normal.dot(moved - point.position_mm) / std::min(normal.dot(point.view), -kMinCosine);
  return slope * shift_mm;
}

double SlideLight::brightness(const LineExposure& exposure, const SlidePoint& point,
                              const RayHit& hit) const {
  const Vec3 to_light = center_mm_ - point.position_mm;
  const double light_mm = to_light.norm();
  const double cosine = point.normal.dot(to_light) / light_mm;
  if (cosine < kMinCosine) return 0.0;
  const double albedo = albedo_at(exposure.scene.mesh(), exposure.albedo, hit);
  const double falloff = center_mm_.squaredNorm() / (light_mm * light_mm);
  return gain_ * albedo * cosine * falloff;
}

double SlideLight::light(const LineExposure& exposure, const SlidePoint& point,
                         const RayHit& hit) const {
  const double offset = from_nearest_line(point.across);
  if (std::abs(offset) > reach(point.blur)) return 0.0;
  double slide_light = 0.0;
  for (const Isometry& T_then_middle : exposure.T_then_middle)
    slide_light += profile_(offset + shift(point, T_then_middle), point.blur);
  if (slide_light <= 0.0) return 0.0;
  return brightness(exposure, point, hit) * slide_light /
         static_cast<double>(exposure.T_then_middle.size());
}

bool SlideLight::shadowed(const LineExposure& exposure, const SlidePoint& point) const {
  return exposure.scene.blocked(exposure.T_model_sensor * point.position_mm,
                                exposure.T_model_sensor.linear() * point.normal,
                                exposure.T_model_sensor * projector_.center());
}

// Each point of the pupil projects its own sharp line, shifted by the defocus. So a partly hidden
// pupil shifts the middle of the line.
double SlideLight::penumbra_share(const LineExposure& exposure, const SlidePoint& point) const {
  const double offset = from_nearest_line(point.across);
  const Vec3 across = projector_.T_sensor_projector.linear().col(0);
  const double defocus = 1.0 / projector_.lens.focus_mm - 1.0 / point.p_projector.z();
  double all = 0.0;
  double arriving = 0.0;
  for (int i = 0; i < kPupilPoints; ++i) {
    const double share = 2.0 * (i + 0.5) / kPupilPoints - 1.0;
    const double place_mm = share * projector_.lens.aperture_radius_mm;
    const double strip = std::abs(defocus) * projector_.lens.aperture_radius_mm / kPupilPoints;
    const double light =
        std::sqrt(1.0 - share * share) * profile_(offset + place_mm * defocus, strip);
    all += light;
    if (light <= 0.0) continue;
    const Vec3 from = projector_.center() + place_mm * across;
    if (!exposure.scene.blocked(exposure.T_model_sensor * point.position_mm,
                                exposure.T_model_sensor.linear() * point.normal,
                                exposure.T_model_sensor * from))
      arriving += light;
  }
  return all > 0.0 ? arriving / all : 0.0;
}

}  // namespace flytri::simulated
