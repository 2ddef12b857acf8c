#include "hw/simulated/optics/lens_blur.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace flytri::simulated {
namespace {

constexpr double kRadiusStep_px = 0.05;
// Depth range outside the volume that is still simulated, in volume depths.
constexpr double kSeenMargin = 1.5;
// Numbers that the processor computes at once (SIMD).
constexpr int kVector = 8;
using Vector = Eigen::Array<float, kVector, 1>;
// Size of a block of pixels. A block reads each kernel row from up to kPad places before its start.
constexpr int kBlock = 4;
constexpr int kPad = kBlock - 1;

// Sample points of the disk, in px.
std::vector<Vec2> disk_points(double radius_px) {
  std::vector<Vec2> points;
  for (int j = -6; j <= 6; ++j)
    for (int i = -6; i <= 6; ++i) {
      const Vec2 p(i / 6.5, j / 6.5);
      if (p.squaredNorm() <= 1.0) points.push_back(radius_px * p);
    }
  return points;
}

// Integral of a Gaussian around `center_px` over each pixel of a row -half..half.
std::vector<double> pixel_shares(double center_px, double sigma_px, int half) {
  const double scale = 1.0 / (std::numbers::sqrt2 * sigma_px);
  std::vector<double> shares;
  for (int i = -half; i <= half; ++i)
    shares.push_back(
        0.5 * (std::erf((i + 0.5 - center_px) * scale) - std::erf((i - 0.5 - center_px) * scale)));
  return shares;
}

// Width in pixels of the blurred row of a block, rounded up to whole vectors.
int block_width(int kernel_width) {
  return (kernel_width + kBlock - 1 + kVector - 1) / kVector * kVector;
}

cv::Mat make_kernel(double radius_px, double sigma_px) {
  const int half = static_cast<int>(std::ceil(radius_px + 3.0 * sigma_px));
  const int side = 2 * half + 1;
  std::vector<double> sums(static_cast<std::size_t>(side) * side, 0.0);
  double total = 0.0;
  for (const Vec2& point : disk_points(radius_px)) {
    const std::vector<double> across = pixel_shares(point.x(), sigma_px, half);
    const std::vector<double> down = pixel_shares(point.y(), sigma_px, half);
    for (int i = 0; i < side * side; ++i) {
      const double share = across[i % side] * down[i / side];
      sums[i] += share;
      total += share;
    }
  }
  cv::Mat kernel(side, side, CV_32FC1);
  for (int i = 0; i < side * side; ++i)
    kernel.at<float>(i / side, i % side) = static_cast<float>(sums[i] / total);
  return kernel;
}

}  // namespace

LensBlur::LensBlur(const CameraModel& camera, double nearest_mm, double farthest_mm)
    : camera_(camera) {
  const double largest = std::max(radius_px(nearest_mm), radius_px(farthest_mm));
  // Lower limit, so that the sum over the kernel is accurate.
  const double sigma_px = std::max(camera.diffraction_sigma_px, 0.2);
  for (double radius = 0.0; radius <= largest + kRadiusStep_px; radius += kRadiusStep_px)
    kernels_.push_back(make_kernel(radius, sigma_px));
  for (const cv::Mat& kernel : kernels_) {
    cv::Mat padded = cv::Mat::zeros(kernel.rows, kPad + block_width(kernel.cols), CV_32FC1);
    kernel.copyTo(padded.colRange(kPad, kPad + kernel.cols));
    padded_.push_back(padded);
  }
}

double LensBlur::radius_px(double distance_mm) const {
  return camera_.lens.blur_radius_mm(distance_mm) / distance_mm * camera_.focal_px;
}

std::size_t LensBlur::index_of(double distance_mm) const {
  const auto index = static_cast<std::size_t>(std::lround(radius_px(distance_mm) / kRadiusStep_px));
  return std::min(index, kernels_.size() - 1);
}

LensBlur LensBlur::around(const calibration::MeasurementVolume& volume, const CameraModel& camera) {
  const double middle_mm = camera.center().norm();
  const double margin_mm = (0.5 + kSeenMargin) * volume.size_mm.z();
  return {camera, std::max(middle_mm - margin_mm, 0.3 * middle_mm), middle_mm + margin_mm};
}

const cv::Mat& LensBlur::kernel(double distance_mm) const {
  return kernels_[index_of(distance_mm)];
}

void LensBlur::spread(float light, int u, int v, double distance_mm, cv::Mat& image) const {
  const std::size_t index = index_of(distance_mm);
  const cv::Mat& k = padded_[index];
  const int half = k.rows / 2;
  const int left = u - half;
  const int width = block_width(kernels_[index].cols);
  const bool inside = left >= 0 && left + width <= image.cols;
  const Vector lights = Vector::Constant(light);
  for (int row = std::max(v - half, 0); row <= std::min(v + half, image.rows - 1); ++row) {
    float* target = image.ptr<float>(row) + left;
    const float* weights = k.ptr<float>(row - v + half) + kPad;
    if (inside) {
      for (int i = 0; i < width; i += kVector)
        Eigen::Map<Vector>(target + i) += lights * Eigen::Map<const Vector>(weights + i);
    } else {
      for (int i = std::max(-left, 0); i < std::min(k.rows, image.cols - left); ++i)
        target[i] += light * weights[i];
    }
  }
}

void LensBlur::spread(const cv::Matx44f& light, int u, int v, double distance_mm,
                      cv::Mat& image) const {
  const std::size_t index = index_of(distance_mm);
  const cv::Mat& k = padded_[index];
  const int half = k.rows / 2;
  const int left = u - half;
  const int width = block_width(kernels_[index].cols);
  if (left < 0 || left + width > image.cols || v + kBlock > image.rows) {
    for (int j = 0; j < std::min(kBlock, image.rows - v); ++j)
      for (int i = 0; i < std::min(kBlock, image.cols - u); ++i)
        spread(light(j, i), u + i, v + j, distance_mm, image);
    return;
  }
  for (int j = 0; j < kBlock; ++j) {
    const float* row_light = light.val + static_cast<std::ptrdiff_t>(kBlock) * j;
    if (row_light[0] + row_light[1] + row_light[2] + row_light[3] <= 0.0F) continue;
    // Copies in registers, so that the compiler need not reload them after the writes below.
    const Vector light_0 = Vector::Constant(row_light[0]);
    const Vector light_1 = Vector::Constant(row_light[1]);
    const Vector light_2 = Vector::Constant(row_light[2]);
    const Vector light_3 = Vector::Constant(row_light[3]);
    const int first = std::max(v + j - half, 0);
    const int last = std::min(v + j + half, image.rows - 1);
    for (int row = first; row <= last; ++row) {
      float* target = image.ptr<float>(row) + left;
      const float* weights = k.ptr<float>(row - v - j + half) + kPad;
      for (int i = 0; i < width; i += kVector) {
        const auto shifted = [&](int pixel) {
          return Eigen::Map<const Vector>(weights + i - pixel);
        };
        Eigen::Map<Vector>(target + i) += (light_0 * shifted(0) + light_1 * shifted(1)) +
                                          (light_2 * shifted(2) + light_3 * shifted(3));
      }
    }
  }
}

}  // namespace flytri::simulated
