#include "core/localization/localize.h"

#include "core/base/check_options.h"
#include "core/localization/find_peaks.h"
#include "core/localization/link_traces.h"

namespace flytri::localization {
namespace {

/// The image turned so that lines cross its rows.
cv::Mat rows_across_lines(const cv::Mat& image, Pattern pattern) {
  if (pattern == Pattern::kVertical) return image;
  cv::Mat rows;
  cv::transpose(image, rows);
  return rows;
}

}  // namespace

Result<void> LocalizeOptions::validate() const {
  return OptionCheck("LocalizeOptions")
      .in_range("detection_sigma_px", detection_sigma_px, 0.5, 3.0)
      .in_range("detection_threshold", detection_threshold, 3.0, 20.0)
      .in_range("max_slope", max_slope, 1.0, 10.0)
      .in_range("dark_share", dark_share, 0.05, Background::kHalf)
      .nested(trim)
      .result();
}

LocalizeOptions for_dense_lines(LocalizeOptions options) {
  // Lines at four times the usual density leave a sixth of a tile dark where they are widest.
  options.dark_share = 0.15;
  return options;
}

Result<std::vector<LineTrace>> localize_lines(const cv::Mat& image, Pattern pattern,
                                              const LocalizeOptions& options) {
  if (const auto valid = options.validate(); !valid) return tl::unexpected(valid.error());
  if (image.empty() || (image.type() != CV_8UC1 && image.type() != CV_16UC1)) {
    return fail(ErrorCode::kBadFormat,
                "the image has a wrong type; a measurement image must be 8- or 16-bit gray");
  }
  const cv::Mat grays = rows_across_lines(image, pattern);
  const Background background(grays, options.dark_share);
  cv::Mat rows;
  grays.convertTo(rows, CV_32F);
  PeakOptions peak_options;
  peak_options.smoothing_sigma_px = options.detection_sigma_px;
  peak_options.threshold = options.detection_threshold;
  peak_options.full_scale = image.depth() == CV_8U ? 255.0F : 65535.0F;
  peak_options.three_point = options.estimator == LineEstimator::kThreePoint;
  const bool is_dense = options.dark_share < Background::kHalf;
  const PeakRows peaks = find_peaks(rows, background, peak_options);
  const auto traces = link_traces(peaks, options.max_slope, options.trim.min_length);
  const auto samples = refine_traces(rows, background, traces,
                                     {options.estimator, peak_options.full_scale, is_dense});
  return trim_traces(samples, rows.rows, options.trim);
}

}  // namespace flytri::localization
