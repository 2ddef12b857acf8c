#include "hw/simulated/line_light.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace flytri {
namespace {

// Lines are traced this far outside the volume; farther away their light is too faint to matter.
constexpr double kDepthMargin = 1.0;  // by the volume's depth
// Pixels around a shadow's edge where the pupil is sampled.
constexpr int kPenumbra_px = 6;
constexpr int kPupilPoints = 7;
// Rays along a line are this many pixels apart.
constexpr double kGuideStep_px = 2.0;
// Guiding rays besides a line's middle, by the reach of its light, and how far around each ray
// pixels are traced: the three strips overlap.
constexpr double kSide = 0.6;
constexpr double kStripShare = 0.5;
// Surfaces this steep send hardly any light.
constexpr double kMinCosine = 0.02;
// A line moves at most about this much during an exposure.
constexpr double kMotion_px = 8.0;

double largest_blur(const ProjectorModel& projector, const SensorModel& sensor) {
  const double middle = projector.center().norm();
  const double farthest = middle + (0.5 + kDepthMargin) * sensor.volume.size_mm.z();
  return projector.lens.blur_radius_mm(farthest) / farthest;
}

}  // namespace

// A pixel that may see the line's light.
struct LineLight::Spot {
  int pixel = 0;
  Vec3 position_mm;           // sensor frame
  Vec3 normal;                // sensor frame, towards the camera
  double distance_mm = 0.0;   // from the camera
  double across = 0.0;        // place on the slide, from the nearest line
  double projector_mm = 0.0;  // from the projector's pupil, along its axis
  double brightness = 0.0;  // albedo, cosine and distance; times the slide's light it is the spot's
  double light = 0.0;
  bool shadowed = false;
};

LineLight::LineLight(const SensorModel& sensor, Pattern pattern)
    : sensor_(sensor),
      projector_(sensor.projector(pattern)),
      profile_(projector_, largest_blur(projector_, sensor)) {
  const double middle_mm = projector_.center().norm();
  const double far_mm = middle_mm + 0.5 * sensor.volume.size_mm.z();
  reach_mm_ = profile_.reach(projector_.lens.blur_radius_mm(far_mm) / far_mm) * far_mm;
  // The camera's blur lowers the peak as widths of Gaussians add.
  const double blur = projector_.lens.blur_radius_mm(middle_mm) / middle_mm;
  const double peak = profile_(0.0, blur);
  const double width_px = 2.0 * projector_.half_width_across / peak * sensor.camera.focal_px;
  const double camera_mm = sensor.camera.center().norm();
  const double camera_blur_px =
      sensor.camera.lens.blur_radius_mm(camera_mm) / camera_mm * sensor.camera.focal_px +
      2.0 * sensor.camera.diffraction_sigma_px;
  gain_ = sensor.chip.line_level / peak * std::hypot(width_px, camera_blur_px) / width_px;
}

double LineLight::nearest_line(double across) const {
  const auto& lines = projector_.line_across;
  const auto after = std::lower_bound(lines.begin(), lines.end(), across);
  if (after == lines.begin()) return across - lines.front();
  if (after == lines.end()) return across - lines.back();
  const double from_after = across - *after;
  const double from_before = across - *(after - 1);
  return -from_after < from_before ? from_after : from_before;
}

cv::Mat LineLight::image(const Exposure& exposure) const {
  cv::Mat light =
      cv::Mat::zeros(sensor_.camera.size.height_px, sensor_.camera.size.width_px, CV_32FC1);
  std::vector<Spot> spots = trace_spots(exposure, pixels_near_lines(exposure));
  cast_shadows(exposure, spots);
  for (const Spot& spot : spots)
    if (spot.light > 0.0)
      exposure.camera_blur.spread(static_cast<float>(spot.light), spot.pixel % light.cols,
                                  spot.pixel / light.cols, spot.distance_mm, light);
  return light;
}

// Rays through the middle and both edges of each line show where its light falls.
std::vector<int> LineLight::pixels_near_lines(const Exposure& exposure) const {
  const CameraModel& camera = sensor_.camera;
  cv::Mat near = cv::Mat::zeros(camera.size.height_px, camera.size.width_px, CV_8UC1);
  const double edge = reach_mm_ / projector_.center().norm();
  const int count =
      static_cast<int>(2.0 * projector_.half_length_along * camera.focal_px / kGuideStep_px) + 2;
  std::vector<Ray> rays;
  const Vec3 origin = exposure.T_model_sensor * projector_.center();
  for (const double line : projector_.line_across)
    for (const double side : {-kSide, 0.0, kSide})
      for (int i = 0; i < count; ++i) {
        const double along = projector_.half_length_along * (2.0 * i / (count - 1) - 1.0);
        rays.push_back({origin, exposure.T_model_sensor.linear() *
                                    projector_.direction(line + side * edge, along)});
      }
  std::vector<std::optional<RayHit>> hits(rays.size());
  exposure.scene.first_hits(rays, hits);
  const Isometry T_sensor_model = exposure.T_model_sensor.inverse();
  for (const auto& hit : hits)
    if (hit) mark_around(T_sensor_model * hit->point_mm, near);
  std::vector<int> pixels;
  for (int i = 0; i < near.rows * near.cols; ++i)
    if (near.data[i] != 0) pixels.push_back(i);
  return pixels;
}

// Marks the pixels across the line at a lit point: as far as its light reaches at that depth.
void LineLight::mark_around(const Vec3& p_sensor, cv::Mat& near) const {
  const auto pixel = sensor_.camera.project(p_sensor);
  if (!pixel || !sensor_.camera.sees(*pixel)) return;
  const double distance_mm = (p_sensor - projector_.center()).norm();
  const double reach = profile_.reach(projector_.lens.blur_radius_mm(distance_mm) / distance_mm);
  const int across = static_cast<int>(std::ceil(kStripShare * reach * sensor_.camera.focal_px)) + 2;
  const int along = static_cast<int>(kGuideStep_px);
  const bool vertical = projector_.pattern == Pattern::kVertical;
  const cv::Size half = vertical ? cv::Size(across, along) : cv::Size(along, across);
  const cv::Rect strip(static_cast<int>(std::lround(pixel->u_px)) - half.width,
                       static_cast<int>(std::lround(pixel->v_px)) - half.height, 2 * half.width + 1,
                       2 * half.height + 1);
  near(strip & cv::Rect(0, 0, near.cols, near.rows)).setTo(1);
}

std::vector<LineLight::Spot> LineLight::trace_spots(const Exposure& exposure,
                                                    const std::vector<int>& pixels) const {
  const Vec3 origin = exposure.T_model_sensor * sensor_.camera.center();
  std::vector<Ray> rays;
  rays.reserve(pixels.size());
  for (const int pixel : pixels)
    rays.push_back({origin, exposure.T_model_sensor.linear() * exposure.directions[pixel]});
  std::vector<std::optional<RayHit>> hits(rays.size());
  exposure.scene.first_hits(rays, hits);
  std::vector<Spot> spots;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    if (!hits[i]) continue;
    Spot spot;
    spot.pixel = pixels[i];
    light_spot(exposure, *hits[i], spot);
    if (spot.brightness > 0.0) spots.push_back(spot);
  }
  return spots;
}

void LineLight::light_spot(const Exposure& exposure, const RayHit& hit, Spot& spot) const {
  const Eigen::Matrix3d R_sensor_model = exposure.T_model_sensor.linear().transpose();
  const Vec3 view = exposure.directions[spot.pixel];
  spot.position_mm = R_sensor_model * (hit.point_mm - exposure.T_model_sensor.translation());
  spot.normal = R_sensor_model * hit.normal;
  const double facing = -spot.normal.dot(view);
  const auto place = projector_.slide_place(spot.position_mm);
  if (facing < kMinCosine || !place || std::abs(place->y()) > projector_.half_length_along) return;
  const Vec3 p_projector =
      projector_.T_sensor_projector.linear().transpose() * (spot.position_mm - projector_.center());
  spot.projector_mm = p_projector.z();
  spot.across = nearest_line(place->x());
  const double blur = projector_.lens.blur_radius_mm(spot.projector_mm) / spot.projector_mm;
  if (std::abs(spot.across) > profile_.reach(blur) + kMotion_px / sensor_.camera.focal_px) return;
  const Vec3 to_light = projector_.center() - spot.position_mm;
  const double light_mm = to_light.norm();
  const double cosine = spot.normal.dot(to_light) / light_mm;
  if (cosine < kMinCosine) return;

  spot.distance_mm = (spot.position_mm - sensor_.camera.center()).norm();
  // Over the exposure the pixel's ray meets the surface's tangent plane at other places: how far
  // the slide's place moves for each mm along the ray.
  const Vec3 view_projector = projector_.T_sensor_projector.linear().transpose() * view;
  const double slope =
      (view_projector.x() - p_projector.x() / p_projector.z() * view_projector.z()) /
      p_projector.z();
  double slide_light = 0.0;
  for (const Isometry& T_then_middle : exposure.T_then_middle) {
    const Vec3 moved = T_then_middle * spot.position_mm;
    const Vec3 normal = T_then_middle.linear() * spot.normal;
    const double shift_mm =
        normal.dot(moved - spot.position_mm) / std::min(normal.dot(view), -kMinCosine);
    slide_light += profile_(spot.across + slope * shift_mm, blur);
  }
  const Triangle& corners = exposure.scene.mesh().triangles[hit.triangle];
  double albedo = 0.0;
  for (int i = 0; i < 3; ++i) albedo += hit.weights[i] * exposure.albedo[corners[i]];
  const double falloff = projector_.center().squaredNorm() / (light_mm * light_mm);
  if (slide_light <= 0.0) return;
  spot.brightness = gain_ * albedo * cosine * falloff;
  spot.light = spot.brightness * slide_light / static_cast<double>(exposure.T_then_middle.size());
}

// Full shadow is asked of the pupil's middle; near a shadow's edge several places of the pupil say
// how much of the light arrives.
void LineLight::cast_shadows(const Exposure& exposure, std::vector<Spot>& spots) const {
  const cv::Size size(sensor_.camera.size.width_px, sensor_.camera.size.height_px);
  cv::Mat lit = cv::Mat::zeros(size, CV_8UC1);
  cv::Mat dark = cv::Mat::zeros(size, CV_8UC1);
  const Vec3 pupil = exposure.T_model_sensor * projector_.center();
  for (Spot& spot : spots) {
    spot.shadowed = exposure.scene.blocked(exposure.T_model_sensor * spot.position_mm,
                                           exposure.T_model_sensor.linear() * spot.normal, pupil);
    (spot.shadowed ? dark : lit).data[spot.pixel] = 1;
  }
  const cv::Mat around = cv::Mat::ones(2 * kPenumbra_px + 1, 2 * kPenumbra_px + 1, CV_8UC1);
  cv::dilate(lit, lit, around);
  cv::dilate(dark, dark, around);
  for (Spot& spot : spots) {
    const bool edge = lit.data[spot.pixel] != 0 && dark.data[spot.pixel] != 0;
    if (edge)
      spot.light *= penumbra_share(exposure, spot);
    else if (spot.shadowed)
      spot.light = 0.0;
  }
}

// Each place of the pupil throws its own sharp line, shifted by the defocus: a partly hidden pupil
// shifts the line's middle.
double LineLight::penumbra_share(const Exposure& exposure, const Spot& spot) const {
  const Vec3 across = projector_.T_sensor_projector.linear().col(0);
  const double defocus = 1.0 / projector_.lens.focus_mm - 1.0 / spot.projector_mm;
  double all = 0.0;
  double arriving = 0.0;
  for (int i = 0; i < kPupilPoints; ++i) {
    const double share = 2.0 * (i + 0.5) / kPupilPoints - 1.0;
    const double place_mm = share * projector_.lens.aperture_radius_mm;
    const double strip = std::abs(defocus) * projector_.lens.aperture_radius_mm / kPupilPoints;
    const double light =
        std::sqrt(1.0 - share * share) * profile_(spot.across + place_mm * defocus, strip);
    all += light;
    if (light <= 0.0) continue;
    const Vec3 from = projector_.center() + place_mm * across;
    if (!exposure.scene.blocked(exposure.T_model_sensor * spot.position_mm,
                                exposure.T_model_sensor.linear() * spot.normal,
                                exposure.T_model_sensor * from))
      arriving += light;
  }
  return all > 0.0 ? arriving / all : 0.0;
}

}  // namespace flytri
