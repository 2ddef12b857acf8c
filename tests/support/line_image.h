/// @file  Draws images of lines with known position, width and noise.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <opencv2/core.hpp>
#include <vector>

#include "core/base/random.h"
#include "core/imaging/pattern.h"

namespace flytri::testing {

/// Properties of an image of lines. "Along" and "across" are relative to the lines.
struct LineImage {
  int along_count = 240;
  int across_count = 200;
  double background = 6.0;
  double background_slope = 0.0;  ///< gray values per px across
  double read_noise = 0.6;
  double shot_gain = 0.0;
  double speckle_contrast = 0.0;
  double full_scale = 255.0;
  int depth = CV_8U;
  std::uint64_t seed = 1;
};

/// A line: its position across and its amplitude in each row, and its sigma. Amplitude 0: no line.
struct TrueLine {
  std::function<double(double)> across_px;
  double sigma_px = 2.0;
  std::function<double(double)> amplitude = [](double) { return 100.0; };
};

/// Draws the lines with noise; the horizontal pattern is the transposed image.
inline cv::Mat draw(const LineImage& image, const std::vector<TrueLine>& lines, Pattern pattern) {
  cv::Mat rows(image.along_count, image.across_count, CV_64F);
  Random random(image.seed);
  for (int r = 0; r < rows.rows; ++r) {
    for (int c = 0; c < rows.cols; ++c) {
      double signal = 0;
      for (const TrueLine& line : lines) {
        const double t = (c - line.across_px(r)) / line.sigma_px;
        signal += line.amplitude(r) * std::exp(-0.5 * t * t);
      }
      const double speckle = image.speckle_contrast * signal;
      const double sigma = std::sqrt(image.read_noise * image.read_noise +
                                     image.shot_gain * signal + speckle * speckle);
      const double value =
          image.background + image.background_slope * c + signal + sigma * random.normal();
      rows.at<double>(r, c) = std::min(std::max(value, 0.0), image.full_scale);
    }
  }
  cv::Mat turned = pattern == Pattern::kHorizontal ? cv::Mat(rows.t()) : rows;
  cv::Mat result;
  turned.convertTo(result, image.depth);
  return result;
}

}  // namespace flytri::testing
