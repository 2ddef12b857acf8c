/// @file  Simulates a camera chip: converts light to pixel values with speckle, shot and read
/// noise.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "core/base/random.h"
#include "hw/simulated/optics/sensor_model.h"

namespace flytri::simulated {

/// A chip with a table of random numbers. Immutable; `read_out` depends only on its arguments.
class Chip {
 public:
  explicit Chip(const ChipModel& model);

  /// Light on the chip during one exposure.
  struct Light {
    cv::Mat line;     ///< CV_32FC1, share of full scale; light of the pattern, which has speckle
    cv::Mat ambient;  ///< CV_32FC1, share of full scale; all other light, same size
  };
  struct ReadOut {
    int bits = 8;       ///< 8 or 16
    int exposures = 1;  ///< >= 1, averaged
    bool noise = true;  ///< false: no noise and no speckle
    std::uint64_t seed = 1;
    std::uint64_t stream = 0;  ///< number of the frame
    /// Take shot and read noise from the table, shifted from frame to frame. Three times faster and
    /// white within an image, but the values repeat.
    bool stored_noise = false;
  };
  /// @return CV_8UC1 or CV_16UC1
  [[nodiscard]] cv::Mat read_out(const Light& light, const ReadOut& how) const;

  /// Adds the chip's noise to an image of light (CV_32FC3, share of full scale) and encodes it.
  /// @return CV_8UC3, R, G, B order, sRGB
  [[nodiscard]] cv::Mat read_out_color(const cv::Mat& light, const ReadOut& how) const;

 private:
  class Noise;

  ChipModel model_;
  std::vector<float> normals_;       // quantiles of the normal distribution
  cv::Mat white_;                    // CV_32FC1, independent normals, wraps around
  cv::Mat speckle_;                  // CV_32FC1, mean 0, standard deviation 1, wraps around
  std::vector<std::uint8_t> codes_;  // sRGB by the share of full scale
};

}  // namespace flytri::simulated
