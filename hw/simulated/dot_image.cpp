#include "hw/simulated/dot_image.h"

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "hw/simulated/lens_blur.h"

namespace flytri {
namespace {

constexpr double kWhiteLevel = 0.7;
constexpr double kBlackLevel = 0.02;
constexpr int kSubpixels = 4;

bool on_dot(const DotTarget& target, const Vec2& p) {
  const Vec2 index(std::round(p.x() / target.pitch_mm), std::round(p.y() / target.pitch_mm));
  const bool marker = index == Vec2(0, 0) || index == Vec2(1, 0) || index == Vec2(0, 2);
  const double diameter_mm = marker ? target.marker_diameter_mm : target.diameter_mm;
  return (p - target.pitch_mm * index).norm() < 0.5 * diameter_mm;
}

// Where each pixel's center looks on the plane.
std::vector<Vec2> places_on_plane(const CameraModel& camera, double z_mm) {
  std::vector<Vec2> places;
  const Vec3 center = camera.center();
  for (const Vec3& direction : camera.pixel_directions())
    places.push_back((center + (z_mm - center.z()) / direction.z() * direction).head<2>());
  return places;
}

}  // namespace

cv::Mat dot_light(const CameraModel& camera, const DotTarget& target, double z_mm) {
  const int width = camera.size.width_px;
  const int height = camera.size.height_px;
  const std::vector<Vec2> places = places_on_plane(camera, z_mm);
  const auto place = [&](int u, int v) { return places[static_cast<std::size_t>(v) * width + u]; };
  cv::Mat light(height, width, CV_32FC1);
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u) {
      // The plane's piece under a pixel is nearly a parallelogram.
      const Vec2 right =
          u + 1 < width ? place(u + 1, v) - place(u, v) : place(u, v) - place(u - 1, v);
      const Vec2 down =
          v + 1 < height ? place(u, v + 1) - place(u, v) : place(u, v) - place(u, v - 1);
      int bright = 0;
      for (int s = 0; s < kSubpixels * kSubpixels; ++s) {
        const int row = s / kSubpixels;
        const double x = (s % kSubpixels + 0.5) / kSubpixels - 0.5;
        const double y = (row + 0.5) / kSubpixels - 0.5;
        bright += on_dot(target, place(u, v) + x * right + y * down) ? 1 : 0;
      }
      const double share = static_cast<double>(bright) / (kSubpixels * kSubpixels);
      light.at<float>(v, u) = static_cast<float>(kBlackLevel + (kWhiteLevel - kBlackLevel) * share);
    }
  const double distance_mm = (Vec3(0.0, 0.0, z_mm) - camera.center()).norm();
  const LensBlur blur(camera, distance_mm, distance_mm);
  cv::filter2D(light, light, -1, blur.kernel(distance_mm), {-1, -1}, 0.0, cv::BORDER_REPLICATE);
  return light;
}

}  // namespace flytri
