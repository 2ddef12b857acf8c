#include "ui/state/exposure.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace flytri::ui {
namespace {

constexpr double kLineQuantile = 0.5, kTextureQuantile = 0.95;

/// Brightness of each pixel as a share of full scale, CV_32F. In color, that of the brightest
/// channel, which clips first.
cv::Mat brightness_of(const cv::Mat& image) {
  cv::Mat brightest = image;
  if (image.channels() > 1) {
    std::vector<cv::Mat> channels;
    cv::split(image, channels);
    brightest = channels.front();
    for (const cv::Mat& channel : channels) cv::max(brightest, channel, brightest);
  }
  const double full_scale = image.depth() == CV_16U ? std::numeric_limits<std::uint16_t>::max()
                                                    : std::numeric_limits<std::uint8_t>::max();
  cv::Mat brightness;
  brightest.convertTo(brightness, CV_32F, 1.0 / full_scale);
  return brightness;
}

/// One pixel for each sample of the found lines.
std::vector<cv::Point> line_pixels(const scan::LiveFrame& frame) {
  const cv::Rect image({0, 0}, frame.frame.image.size());
  std::vector<cv::Point> pixels;
  for (const std::vector<Pixel>& line : frame.lines) {
    for (const Pixel& sample : line) {
      const cv::Point pixel(cvRound(sample.u_px), cvRound(sample.v_px));
      if (image.contains(pixel)) pixels.push_back(pixel);
    }
  }
  return pixels;
}

std::vector<cv::Point> all_pixels(const cv::Size& size) {
  std::vector<cv::Point> pixels;
  pixels.reserve(static_cast<std::size_t>(size.area()));
  for (int v = 0; v < size.height; ++v)
    for (int u = 0; u < size.width; ++u) pixels.emplace_back(u, v);
  return pixels;
}

void fill_histogram(Exposure& exposure, const cv::Mat& brightness) {
  const double share = 1.0 / static_cast<double>(brightness.total());
  for (int v = 0; v < brightness.rows; ++v) {
    const auto* row = brightness.ptr<float>(v);
    for (int u = 0; u < brightness.cols; ++u) {
      const auto bin = static_cast<std::size_t>(row[u] * static_cast<float>(Exposure::kBins));
      exposure.histogram[std::min(bin, Exposure::kBins - 1)] += share;
    }
  }
}

/// @param quantile  0..1, of the levels: reported as the level of all
void judge(Exposure& exposure, std::vector<float>& levels, double quantile,
           const ExposureLimits& limits) {
  if (levels.empty()) return;
  const auto clipped = std::count_if(levels.begin(), levels.end(),
                                     [&](float level) { return level >= limits.clipped; });
  exposure.saturated_share = static_cast<double>(clipped) / static_cast<double>(levels.size());
  const auto at = static_cast<std::ptrdiff_t>(quantile * static_cast<double>(levels.size() - 1));
  std::nth_element(levels.begin(), levels.begin() + at, levels.end());
  exposure.level = levels[static_cast<std::size_t>(at)];
}

ExposureVerdict verdict_on(const Exposure& exposure, double min_level,
                           const ExposureLimits& limits) {
  if (exposure.saturated_share > limits.max_saturated) return ExposureVerdict::kTooBright;
  return exposure.level < min_level ? ExposureVerdict::kTooDark : ExposureVerdict::kWell;
}

}  // namespace

Exposure measure_exposure(const scan::LiveFrame& frame, const ExposureLimits& limits) {
  Exposure exposure;
  const cv::Mat& image = frame.frame.image;
  if (image.empty()) return exposure;
  const cv::Mat brightness = brightness_of(image);
  fill_histogram(exposure, brightness);
  const bool is_texture = frame.frame.kind == FrameKind::kTexture;
  const auto judged = is_texture ? all_pixels(image.size()) : line_pixels(frame);
  exposure.marks = cv::Mat(image.size(), CV_8U, cv::Scalar(0));
  std::vector<float> levels;
  levels.reserve(judged.size());
  for (const cv::Point& pixel : judged) {
    levels.push_back(brightness.at<float>(pixel));
    if (levels.back() < limits.dark)
      exposure.marks.at<std::uint8_t>(pixel) = static_cast<std::uint8_t>(ExposureMark::kDark);
  }
  exposure.marks.setTo(static_cast<double>(ExposureMark::kSaturated), brightness >= limits.clipped);
  judge(exposure, levels, is_texture ? kTextureQuantile : kLineQuantile, limits);
  const double min_level = is_texture ? limits.min_texture_level : limits.dark;
  if (!levels.empty()) exposure.verdict = verdict_on(exposure, min_level, limits);
  return exposure;
}

std::string exposure_advice(const Exposure& exposure, FrameKind kind, const Texts& texts) {
  const bool is_texture = kind == FrameKind::kTexture;
  const double level_percent = 100.0 * exposure.level;
  switch (exposure.verdict) {
    case ExposureVerdict::kWell:
      return is_texture ? texts.fill<Text::kExposureGoodTeeth>(level_percent)
                        : texts.fill<Text::kExposureGoodLines>(level_percent);
    case ExposureVerdict::kTooBright: {
      const double percent = std::max(100.0 * exposure.saturated_share, 1.0);
      return is_texture ? texts.fill<Text::kExposureReduceImage>(percent)
                        : texts.fill<Text::kExposureReduceLines>(percent);
    }
    case ExposureVerdict::kTooDark:
      return is_texture ? texts.fill<Text::kExposureIncreaseTeeth>(level_percent)
                        : texts.fill<Text::kExposureIncreaseLines>(level_percent);
    case ExposureVerdict::kNothingSeen:
      break;
  }
  return texts[Text::kExposureNoLines];
}

}  // namespace flytri::ui
