#include "hw/simulated/optics/line_light.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace flytri::simulated {
namespace {

// Distance from a shadow's edge, in pixels, within which the pupil is sampled.
constexpr int kPenumbra_px = 6;
// Distance of guiding rays along a line, in pixels.
constexpr double kGuideStep_px = 2.0;
// Offset of the two side rays from the line's middle, and half width of the traced strip around
// each ray; both as a share of the reach of the light. The three strips overlap.
constexpr double kSide = 0.6;
constexpr double kStripShare = 0.5;

}  // namespace

// A pixel lit by the line.
struct LineLight::Spot {
  int pixel = 0;
  SlidePoint point;
  double light = 0.0;
  bool shadowed = false;
};

LineLight::LineLight(const SensorModel& sensor, Pattern pattern)
    : camera_(sensor.camera), slide_(sensor, pattern) {
  const ProjectorModel& projector = slide_.projector();
  const double far_mm = projector.center().norm() + 0.5 * sensor.volume.size_mm.z();
  reach_mm_ = slide_.profile().reach(projector.lens.blur_radius_mm(far_mm) / far_mm) * far_mm;
}

cv::Mat LineLight::image(const LineExposure& exposure) const {
  cv::Mat light = cv::Mat::zeros(camera_.size.height_px, camera_.size.width_px, CV_32FC1);
  std::vector<Spot> spots = trace_spots(exposure, pixels_near_lines(exposure));
  cast_shadows(exposure, spots);
  for (const Spot& spot : spots)
    if (spot.light > 0.0)
      exposure.camera_blur.spread(static_cast<float>(spot.light), spot.pixel % light.cols,
                                  spot.pixel / light.cols,
                                  (spot.point.position_mm - camera_.center()).norm(), light);
  return light;
}

// Traces rays through the middle and both sides of each line to find the pixels that it lights.
std::vector<int> LineLight::pixels_near_lines(const LineExposure& exposure) const {
  const ProjectorModel& projector = slide_.projector();
  cv::Mat near = cv::Mat::zeros(camera_.size.height_px, camera_.size.width_px, CV_8UC1);
  const double edge = reach_mm_ / projector.center().norm();
  const int count =
      static_cast<int>(2.0 * projector.half_length_along * camera_.focal_px / kGuideStep_px) + 2;
  std::vector<Ray> rays;
  const Vec3 origin = exposure.T_model_sensor * projector.center();
  for (const double line : projector.line_across)
    for (const double side : {-kSide, 0.0, kSide})
      for (int i = 0; i < count; ++i) {
        const double along = projector.half_length_along * (2.0 * i / (count - 1) - 1.0);
        rays.push_back({origin, exposure.T_model_sensor.linear() *
                                    projector.direction(line + side * edge, along)});
      }
  std::vector<std::optional<RayHit>> hits(rays.size());
  exposure.scene.first_hits(rays, hits);
  const Isometry T_sensor_model = exposure.T_model_sensor.inverse();
  for (const auto& hit : hits)
    if (hit) mark_around(T_sensor_model * hit->point_mm, near);
  std::vector<int> pixels;
  // Light of the rows beside these reaches them, and edges of shadows need their surroundings.
  const int beside_px = exposure.camera_blur.reach_px() + kPenumbra_px;
  const cv::Range all(0, near.rows);
  const cv::Range rows =
      exposure.rows == cv::Range::all()
          ? all
          : all & cv::Range(exposure.rows.start - beside_px, exposure.rows.end + beside_px);
  for (int i = rows.start * near.cols; i < rows.end * near.cols; ++i)
    if (near.data[i] != 0) pixels.push_back(i);
  return pixels;
}

// Marks the pixels across the line at a lit point, up to the reach of the light at that depth.
void LineLight::mark_around(const Vec3& p_sensor, cv::Mat& near) const {
  const auto pixel = camera_.project(p_sensor);
  if (!pixel || !camera_.sees(*pixel)) return;
  const ProjectorModel& projector = slide_.projector();
  const double distance_mm = (p_sensor - projector.center()).norm();
  const double reach =
      slide_.profile().reach(projector.lens.blur_radius_mm(distance_mm) / distance_mm);
  const int across = static_cast<int>(std::ceil(kStripShare * reach * camera_.focal_px)) + 2;
  const int along = static_cast<int>(kGuideStep_px);
  const bool vertical = projector.pattern == Pattern::kVertical;
  const cv::Size half = vertical ? cv::Size(across, along) : cv::Size(along, across);
  const cv::Rect strip(static_cast<int>(std::lround(pixel->u_px)) - half.width,
                       static_cast<int>(std::lround(pixel->v_px)) - half.height, 2 * half.width + 1,
                       2 * half.height + 1);
  near(strip & cv::Rect(0, 0, near.cols, near.rows)).setTo(1);
}

std::vector<LineLight::Spot> LineLight::trace_spots(const LineExposure& exposure,
                                                    const std::vector<int>& pixels) const {
  const Vec3 origin = exposure.T_model_sensor * camera_.center();
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
    if (spot.light > 0.0) spots.push_back(spot);
  }
  return spots;
}

void LineLight::light_spot(const LineExposure& exposure, const RayHit& hit, Spot& spot) const {
  const auto point = slide_.point(exposure, exposure.directions[spot.pixel], hit);
  if (!point) return;
  spot.point = *point;
  spot.light = slide_.light(exposure, *point, hit);
}

// Tests for full shadow with one ray to the middle of the pupil; near a shadow's edge, several
// points of the pupil determine the share of light.
void LineLight::cast_shadows(const LineExposure& exposure, std::vector<Spot>& spots) const {
  const cv::Size size(camera_.size.width_px, camera_.size.height_px);
  cv::Mat lit = cv::Mat::zeros(size, CV_8UC1);
  cv::Mat dark = cv::Mat::zeros(size, CV_8UC1);
  for (Spot& spot : spots) {
    spot.shadowed = slide_.shadowed(exposure, spot.point);
    (spot.shadowed ? dark : lit).data[spot.pixel] = 1;
  }
  const cv::Mat around = cv::Mat::ones(2 * kPenumbra_px + 1, 2 * kPenumbra_px + 1, CV_8UC1);
  cv::dilate(lit, lit, around);
  cv::dilate(dark, dark, around);
  for (Spot& spot : spots) {
    const bool edge = lit.data[spot.pixel] != 0 && dark.data[spot.pixel] != 0;
    if (edge)
      spot.light *= slide_.penumbra_share(exposure, spot.point);
    else if (spot.shadowed)
      spot.light = 0.0;
  }
}

}  // namespace flytri::simulated
