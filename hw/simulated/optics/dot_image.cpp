#include "hw/simulated/optics/dot_image.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "hw/simulated/optics/lens_blur.h"

namespace flytri::simulated {
namespace {

constexpr double kWhiteLevel = 0.7;
constexpr double kBlackLevel = 0.02;
constexpr int kSubpixels = 4;

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
  const bool marker = (j == 0.0 && (i == 0.0 || i == 1.0)) || (i == 0.0 && j == 2.0);
  const double diameter_mm = marker ? target.marker_diameter_mm : target.diameter_mm;
  return {(p - target.pitch_mm * Vec2(i, j)).squaredNorm(), 0.5 * diameter_mm};
}

}  // namespace

DotImage::DotImage(const CameraModel& camera, const calibration::DotTarget& target)
    : camera_(camera), target_(target), directions_(camera.pixel_directions()) {}

// The point of the target that each pixel center sees.
std::vector<Vec2> DotImage::places_on_plane(double z_mm, const Vec2& aside_mm) const {
  std::vector<Vec2> places;
  places.reserve(directions_.size());
  const Vec3 center = camera_.center();
  for (const Vec3& direction : directions_)
    places.push_back((center + (z_mm - center.z()) / direction.z() * direction).head<2>() -
                     aside_mm);
  return places;
}

// Bright share of the area that a pixel sees: nearly a parallelogram with these sides.
double DotImage::bright_share(const Vec2& place, const Vec2& right, const Vec2& down) const {
  // Largest distance of a point of the area from its middle.
  const double reach_mm = 0.5 * (right.lpNorm<1>() + down.lpNorm<1>());
  const AtDot middle = at_dot(target_, place);
  if (middle.inside(reach_mm)) return 1.0;
  if (!middle.inside(-reach_mm)) return 0.0;
  int bright = 0;
  for (int j = 0; j < kSubpixels; ++j)
    for (int i = 0; i < kSubpixels; ++i) {
      const Vec2 part((i + 0.5) / kSubpixels - 0.5, (j + 0.5) / kSubpixels - 0.5);
      if (at_dot(target_, place + part.x() * right + part.y() * down).inside()) ++bright;
    }
  return static_cast<double>(bright) / (kSubpixels * kSubpixels);
}

cv::Mat DotImage::light(double z_mm, const Vec2& aside_mm) const {
  const int width = camera_.size.width_px;
  const int height = camera_.size.height_px;
  const std::vector<Vec2> places = places_on_plane(z_mm, aside_mm);
  const auto place = [&](int u, int v) { return places[static_cast<std::size_t>(v) * width + u]; };
  cv::Mat light(height, width, CV_32FC1);
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u) {
      const Vec2 right =
          u + 1 < width ? place(u + 1, v) - place(u, v) : place(u, v) - place(u - 1, v);
      const Vec2 down =
          v + 1 < height ? place(u, v + 1) - place(u, v) : place(u, v) - place(u, v - 1);
      light.at<float>(v, u) = static_cast<float>(
          kBlackLevel + (kWhiteLevel - kBlackLevel) * bright_share(place(u, v), right, down));
    }
  const double distance_mm = (Vec3(0.0, 0.0, z_mm) - camera_.center()).norm();
  const LensBlur blur(camera_, distance_mm, distance_mm);
  cv::filter2D(light, light, -1, blur.kernel(distance_mm), {-1, -1}, 0.0, cv::BORDER_REPLICATE);
  return light;
}

}  // namespace flytri::simulated
