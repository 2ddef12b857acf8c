/// @file  How a camera's lens spreads the light of one pixel over its neighbors.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "hw/simulated/optics/sensor_model.h"

namespace flytri::simulated {

/// Kernels of defocus (a disk), diffraction (a Gaussian) and the pixel's own area. Immutable.
class LensBlur {
 public:
  /// @param nearest_mm, farthest_mm  distances from the pupil that will be asked for
  LensBlur(const CameraModel& camera, double nearest_mm, double farthest_mm);

  /// Square kernel with odd sides and sum 1, CV_32FC1.
  [[nodiscard]] const cv::Mat& kernel(double distance_mm) const;
  /// Adds `light` at a pixel, spread by the kernel. `image` is CV_32FC1.
  void spread(float light, int u, int v, double distance_mm, cv::Mat& image) const;
  /// The same for a block of pixels at one distance, of which (u, v) is the left upper; those
  /// outside the image are left out.
  void spread(const cv::Matx44f& light, int u, int v, double distance_mm, cv::Mat& image) const;

 private:
  double radius_px(double distance_mm) const;
  std::size_t index_of(double distance_mm) const;

  CameraModel camera_;
  std::vector<cv::Mat> kernels_;  // by radius
  // The same, with kPad zeros before each row and zeros after it, to be read in whole vectors.
  std::vector<cv::Mat> padded_;
};

}  // namespace flytri::simulated
