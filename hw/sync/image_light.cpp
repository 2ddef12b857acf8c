#include "hw/sync/image_light.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/base/check_options.h"
#include "core/base/median.h"

namespace flytri::sync {
namespace {

/// Pixels averaged across a line: half the width of the narrowest line.
constexpr int kAcross_px = 2;

/// Result for strips of one direction.
struct StripLight {
  double lines = 0.0;
  double area = 0.0;
  double darkest = 0.0;
  int places = 0;
};

/// Half a step of 8 bits: a fainter line is useless and cannot be distinguished from rounding.
constexpr float kFaintest = 0.5F / 255.0F;

/// Standard deviation of the noise, from differences of neighbors along a strip; few of them are at
/// edges of lines.
float noise_of(const cv::Mat& strips) {
  std::vector<float> steps;
  steps.reserve(strips.total());
  for (int row = 0; row < strips.rows; ++row) {
    const float* cells = strips.ptr<float>(row);
    for (int i = 1; i < strips.cols; ++i) steps.push_back(std::abs(cells[i] - cells[i - 1]));
  }
  if (steps.empty()) return 0.0F;
  return static_cast<float>(kSigmaOfMedian / std::sqrt(2.0)) * median_of(steps);
}

/// @param strips  CV_32F, one strip per row, share of full scale
StripLight measure_strips(const cv::Mat& strips, const ImageLightOptions& options) {
  const int width = std::max(3, static_cast<int>(options.line_width_share * strips.cols)) | 1;
  cv::Mat areas;
  cv::morphologyEx(strips, areas, cv::MORPH_OPEN, cv::Mat::ones(1, width, CV_8U), {-1, -1}, 1,
                   cv::BORDER_REPLICATE);
  const cv::Mat hat = strips - areas;
  const float threshold = static_cast<float>(options.threshold) * noise_of(strips) + kFaintest;
  const cv::Mat lit = hat > threshold;
  std::vector<float> levels(areas.begin<float>(), areas.end<float>());
  const auto low = levels.begin() + static_cast<std::ptrdiff_t>(levels.size() / 20);
  std::nth_element(levels.begin(), low, levels.end());
  const int places = cv::countNonZero(lit);
  const double lines = cv::mean(hat, lit)[0] * places / static_cast<double>(hat.total());
  return {lines, cv::mean(areas)[0] - *low, *low, places};
}

}  // namespace

Result<void> ImageLightOptions::validate() const {
  return OptionCheck("ImageLightOptions")
      .in_range("strip_px", strip_px, 4, 64)
      .in_range("line_width_share", line_width_share, 0.01, 0.2)
      .above("threshold", threshold, 1.0)
      .result();
}

ImageLight measure_image_light(const cv::Mat& image, const ImageLightOptions& options) {
  cv::Mat gray = image;
  if (image.channels() == 3) cv::extractChannel(image, gray, 1);
  cv::Mat light;
  gray.convertTo(light, CV_32F, gray.depth() == CV_16U ? 1.0 / 65535.0 : 1.0 / 255.0);
  // Block means: long along the lines to detect, short across.
  const auto blocks = [&](int width_px, int height_px) {
    cv::Mat means;
    const cv::Size size(std::max(1, light.cols / width_px), std::max(1, light.rows / height_px));
    cv::resize(light, means, size, 0.0, 0.0, cv::INTER_AREA);
    return means;
  };
  const StripLight columns = measure_strips(blocks(kAcross_px, options.strip_px), options);
  const StripLight rows = measure_strips(blocks(options.strip_px, kAcross_px).t(), options);
  return {columns.lines, rows.lines, std::min(columns.area, rows.area),
          std::min(columns.darkest, rows.darkest), columns.places + rows.places};
}

}  // namespace flytri::sync
