#include "hw/simulated/lens_blur.h"

#include <algorithm>
#include <cmath>

namespace flytri {
namespace {

constexpr double kRadiusStep_px = 0.05;
constexpr int kSubpixels = 5;

// The disk cut into points, as offsets in px.
std::vector<Vec2> disk_points(double radius_px) {
  std::vector<Vec2> points;
  for (int j = -6; j <= 6; ++j)
    for (int i = -6; i <= 6; ++i) {
      const Vec2 p(i / 6.5, j / 6.5);
      if (p.squaredNorm() <= 1.0) points.push_back(radius_px * p);
    }
  return points;
}

cv::Mat make_kernel(double radius_px, double sigma_px) {
  const int half = static_cast<int>(std::ceil(radius_px + 3.0 * sigma_px));
  const std::vector<Vec2> points = disk_points(radius_px);
  cv::Mat kernel(2 * half + 1, 2 * half + 1, CV_32FC1);
  for (int v = -half; v <= half; ++v)
    for (int u = -half; u <= half; ++u) {
      double sum = 0.0;
      for (int s = 0; s < kSubpixels * kSubpixels; ++s) {
        const Vec2 p(u + (s % kSubpixels + 0.5) / kSubpixels - 0.5,
                     v + (s / kSubpixels + 0.5) / kSubpixels - 0.5);
        for (const Vec2& point : points)
          sum += std::exp(-0.5 * (p - point).squaredNorm() / (sigma_px * sigma_px));
      }
      kernel.at<float>(v + half, u + half) = static_cast<float>(sum);
    }
  return kernel / cv::sum(kernel)[0];
}

}  // namespace

LensBlur::LensBlur(const CameraModel& camera, double nearest_mm, double farthest_mm)
    : camera_(camera) {
  const double largest = std::max(radius_px(nearest_mm), radius_px(farthest_mm));
  // A kernel needs some extent to be summed over.
  const double sigma_px = std::max(camera.diffraction_sigma_px, 0.2);
  for (double radius = 0.0; radius <= largest + kRadiusStep_px; radius += kRadiusStep_px)
    kernels_.push_back(make_kernel(radius, sigma_px));
}

double LensBlur::radius_px(double distance_mm) const {
  return camera_.lens.blur_radius_mm(distance_mm) / distance_mm * camera_.focal_px;
}

const cv::Mat& LensBlur::kernel(double distance_mm) const {
  const auto index = static_cast<std::size_t>(std::lround(radius_px(distance_mm) / kRadiusStep_px));
  return kernels_[std::min(index, kernels_.size() - 1)];
}

void LensBlur::spread(float light, int u, int v, double distance_mm, cv::Mat& image) const {
  const cv::Mat& k = kernel(distance_mm);
  const int half = k.rows / 2;
  const int begin = std::max(u - half, 0);
  const int end = std::min(u + half + 1, image.cols);
  for (int row = std::max(v - half, 0); row < std::min(v + half + 1, image.rows); ++row) {
    float* target = image.ptr<float>(row);
    const float* weights = k.ptr<float>(row - v + half) + half - u;
    for (int column = begin; column < end; ++column) target[column] += light * weights[column];
  }
}

}  // namespace flytri
