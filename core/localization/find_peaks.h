/// @file  Finds the sub-pixel positions where lines cross each image row.
#pragma once

#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "core/localization/background.h"

namespace flytri::localization {

/// A peak of a smoothed row.
struct Peak {
  int row = 0;
  float center_px = 0;       ///< middle between the two flanks: less noisy than the top under
                             ///< speckle
  float three_point_px = 0;  ///< by three-point Gaussian interpolation of the top
  float sigma_px = 0;        ///< of a Gaussian with these flanks, corrected for the smoothing
  float amplitude = 0;       ///< above the local background, corrected for the smoothing
  float room_px = 0;         ///< half the distance to the nearest other peak of the row
  bool saturated = false;
};

/// The peaks of an image by row, and by rising column in each row.
class PeakRows {
 public:
  [[nodiscard]] int row_count() const { return static_cast<int>(first_.size()) - 1; }
  [[nodiscard]] std::span<const Peak> row(int r) const {
    const auto i = static_cast<std::size_t>(r);
    return std::span(peaks_).subspan(first_[i], first_[i + 1] - first_[i]);
  }
  void add_row(std::span<const Peak> peaks) {
    peaks_.insert(peaks_.end(), peaks.begin(), peaks.end());
    first_.push_back(peaks_.size());
  }

 private:
  std::vector<Peak> peaks_;
  std::vector<std::size_t> first_ = {0};  ///< start of each row, then the end
};

/// What counts as a peak.
struct PeakOptions {
  double smoothing_sigma_px = 1.0;
  double threshold = 5.0;     ///< in standard deviations of the smoothed background noise
  float full_scale = 255.0F;  ///< gray value at which the camera clips
  bool three_point = false;   ///< compute Peak::three_point_px
};

/// Finds the peaks of each row. Two maxima with a shallow valley between them are one peak that
/// speckle has split.
/// @param rows  CV_32FC1; lines cross the rows.
/// @source  Arold et al., "Line Localization".
[[nodiscard]] PeakRows find_peaks(const cv::Mat& rows, const Background& background,
                                  const PeakOptions& options);

}  // namespace flytri::localization
