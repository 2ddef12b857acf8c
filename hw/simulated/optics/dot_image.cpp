#include "hw/simulated/optics/dot_image.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "hw/simulated/optics/lens_blur.h"

namespace flytri::simulated {
namespace {

constexpr int kSubpixels = 4;
// The blur of a tilted target is interpolated between this many distances.
constexpr int kBlurLayers = 5;

// A place on the target, relative to the nearest dot.
struct AtDot {
  double squared_distance_mm2;  // from the dot's center
  double radius_mm;             // of the dot
  [[nodiscard]] bool inside(double by_mm = 0.0) const {
    const double least_mm = radius_mm - by_mm;
    return least_mm > 0.0 && squared_distance_mm2 < least_mm * least_mm;
  }
};

AtDot at_dot(const calibration::DotTarget& target, const Vec2& p) {
  const double i = std::nearbyint(p.x() / target.pitch_mm);
  const double j = std::nearbyint(p.y() / target.pitch_mm);
  return {(p - target.pitch_mm * Vec2(i, j)).squaredNorm(),
          0.5 * target.diameter_of(static_cast<int>(i), static_cast<int>(j))};
}

}  // namespace

// What each pixel's center sees.
struct DotImage::Seen {
  std::vector<Vec3> p_sensor;
  std::vector<Vec2> places;  // on the target
  double nearest_mm = 0.0, farthest_mm = 0.0;
};

DotImage::DotImage(const CameraModel& camera, const calibration::DotTarget& target,
                   const DotLook& look)
    : camera_(camera), target_(target), look_(look), directions_(camera.pixel_directions()) {}

DotImage::Seen DotImage::seen_of(const Isometry& T_sensor_target) const {
  Seen seen;
  seen.p_sensor.reserve(directions_.size());
  seen.places.reserve(directions_.size());
  const Vec3 center = camera_.center();
  const Vec3 origin = T_sensor_target.translation();
  const Vec3 normal = T_sensor_target.linear().col(2);
  const double height_mm = normal.dot(origin - center);
  seen.nearest_mm = seen.farthest_mm = (origin - center).norm();
  for (const Vec3& direction : directions_) {
    const Vec3 p = center + height_mm / normal.dot(direction) * direction;
    seen.p_sensor.push_back(p);
    seen.places.emplace_back((T_sensor_target.linear().transpose() * (p - origin)).head<2>());
  }
  if (normal.head<2>().isZero()) return seen;
  for (const Vec3& p : seen.p_sensor) {
    const double distance_mm = (p - center).norm();
    seen.nearest_mm = std::min(seen.nearest_mm, distance_mm);
    seen.farthest_mm = std::max(seen.farthest_mm, distance_mm);
  }
  return seen;
}

// Share of a dot in the area that a pixel sees: nearly a parallelogram with these sides.
double DotImage::dot_share(const Vec2& place, const Vec2& right, const Vec2& down) const {
  // Largest distance of a point of the area from its middle.
  const double reach_mm = 0.5 * (right.lpNorm<1>() + down.lpNorm<1>());
  const AtDot middle = at_dot(target_, place);
  if (middle.inside(reach_mm)) return 1.0;
  if (!middle.inside(-reach_mm)) return 0.0;
  int inside = 0;
  for (int j = 0; j < kSubpixels; ++j)
    for (int i = 0; i < kSubpixels; ++i) {
      const Vec2 part((i + 0.5) / kSubpixels - 0.5, (j + 0.5) / kSubpixels - 0.5);
      if (at_dot(target_, place + part.x() * right + part.y() * down).inside()) ++inside;
    }
  return static_cast<double>(inside) / (kSubpixels * kSubpixels);
}

double DotImage::shading(const Vec3& p_sensor, const Vec3& normal) const {
  const Vec3 to_lamp = *look_.lamp_mm - p_sensor;
  const double cosine = std::abs(normal.dot(to_lamp)) / to_lamp.norm();
  return cosine * look_.lamp_mm->squaredNorm() / to_lamp.squaredNorm();
}

cv::Mat DotImage::blurred(const cv::Mat& light, const Seen& seen) const {
  const LensBlur blur(camera_, seen.nearest_mm, seen.farthest_mm);
  const auto at = [&](double distance_mm) {
    cv::Mat result;
    cv::filter2D(light, result, -1, blur.kernel(distance_mm), {-1, -1}, 0.0, cv::BORDER_REPLICATE);
    return result;
  };
  if (seen.nearest_mm == seen.farthest_mm) return at(seen.nearest_mm);
  const double step_mm = (seen.farthest_mm - seen.nearest_mm) / (kBlurLayers - 1);
  std::vector<cv::Mat> layers;
  layers.reserve(kBlurLayers);
  for (int k = 0; k < kBlurLayers; ++k) layers.push_back(at(seen.nearest_mm + k * step_mm));
  const Vec3 center = camera_.center();
  cv::Mat result(light.size(), CV_32FC1);
  for (int i = 0; i < static_cast<int>(light.total()); ++i) {
    const double distance_mm = (seen.p_sensor[static_cast<std::size_t>(i)] - center).norm();
    const double place = (distance_mm - seen.nearest_mm) / step_mm;
    const int k = std::clamp(static_cast<int>(place), 0, kBlurLayers - 2);
    const auto share = static_cast<float>(place - k);
    result.at<float>(i) = (1.0F - share) * layers[static_cast<std::size_t>(k)].at<float>(i) +
                          share * layers[static_cast<std::size_t>(k) + 1].at<float>(i);
  }
  return result;
}

cv::Mat DotImage::light(const Isometry& T_sensor_target) const {
  const int width = camera_.size.width_px;
  const int height = camera_.size.height_px;
  const Seen seen = seen_of(T_sensor_target);
  const Vec3 normal = T_sensor_target.linear().col(2);
  const auto index = [width](int u, int v) { return static_cast<std::size_t>(v) * width + u; };
  const auto place = [&](int u, int v) { return seen.places[index(u, v)]; };
  cv::Mat light(height, width, CV_32FC1);
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u) {
      const Vec2 right =
          u + 1 < width ? place(u + 1, v) - place(u, v) : place(u, v) - place(u - 1, v);
      const Vec2 down =
          v + 1 < height ? place(u, v + 1) - place(u, v) : place(u, v) - place(u, v - 1);
      double level = look_.background_level + (look_.dot_level - look_.background_level) *
                                                  dot_share(place(u, v), right, down);
      if (look_.lamp_mm) level *= shading(seen.p_sensor[index(u, v)], normal);
      light.at<float>(v, u) = static_cast<float>(level);
    }
  return blurred(light, seen);
}

}  // namespace flytri::simulated
