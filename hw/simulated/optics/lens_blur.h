/// @file  Simulates how a camera lens spreads the light of a pixel over its neighbors.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "hw/simulated/optics/sensor_model.h"

namespace flytri::simulated {

/// Blur kernels from defocus (disk), diffraction (Gaussian) and the pixel's area. Immutable.
class LensBlur {
 public:
  /// @param nearest_mm,  farthest_mm range of distances from the pupil that will be used
  LensBlur(const CameraModel& camera, double nearest_mm, double farthest_mm);

  /// For what a camera sees in and around a measurement volume.
  [[nodiscard]] static LensBlur around(const calibration::MeasurementVolume& volume,
                                       const CameraModel& camera);

  /// Square kernel with odd sides and sum 1, CV_32FC1.
  [[nodiscard]] const cv::Mat& kernel(double distance_mm) const;
  /// Light is spread by at most this many pixels.
  [[nodiscard]] int reach_px() const { return kernels_.back().rows / 2; }
  /// Adds `light` at a pixel, spread by the kernel. `image` is CV_32FC1.
  void spread(float light, int u, int v, double distance_mm, cv::Mat& image) const;
  /// The same for a block of pixels at one distance with left upper pixel (u, v); pixels outside
  /// the image are skipped.
  void spread(const cv::Matx44f& light, int u, int v, double distance_mm, cv::Mat& image) const;

 private:
  double radius_px(double distance_mm) const;
  std::size_t index_of(double distance_mm) const;

  CameraModel camera_;
  std::vector<cv::Mat> kernels_;  // by radius
  // The same with kPad zeros before and zeros after each row, so that whole vectors can be read.
  std::vector<cv::Mat> padded_;
};

}  // namespace flytri::simulated
