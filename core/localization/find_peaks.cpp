#include "core/localization/find_peaks.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

namespace flytri::localization {
namespace {

/// Pixels computed together; a group without a bright pixel is skipped.
constexpr int kLanes = 16;
using Lanes = Eigen::Array<float, kLanes, 1>;
/// The flanks are measured at this share of the peak height. Two maxima are two lines if the valley
/// between them is below this share. Two equal Gaussians 1.2 widths apart have a valley of 0.74.
constexpr float kFlankLevel = 0.7F;
constexpr float kFlankDistance = 1.6892F;  // between the flanks of a Gaussian at that height, in
                                           // sigmas
constexpr float kMinVariance = 0.05F;      // px^2; a narrower peak is a hot pixel, not a line

/// One side of a sampled Gaussian of unit sum: weights at 0, 1, 2, ... px.
std::vector<float> half_kernel(float sigma) {
  const int radius = static_cast<int>(std::ceil(3.0F * sigma));
  std::vector<float> half;
  float sum = 0;
  for (int k = 0; k <= radius; ++k) {
    half.push_back(std::exp(-0.5F * static_cast<float>(k * k) / (sigma * sigma)));
    sum += k == 0 ? half.back() : 2.0F * half.back();
  }
  for (float& weight : half) weight /= sum;
  return half;
}

/// Smooths one row. The ends, where the kernel does not fit, stay as they are.
void smooth_row(std::span<const float> row, std::span<const float> half, std::span<float> smooth) {
  const std::size_t radius = half.size() - 1;
  if (row.size() < 2 * radius + kLanes) return;
  const std::size_t last = row.size() - radius - kLanes;
  for (std::size_t c = radius; c < last + kLanes; c += kLanes) {
    const float* center = row.data() + std::min(c, last);
    Lanes sum = half[0] * Eigen::Map<const Lanes>(center);
    for (std::size_t k = 1; k <= radius; ++k) {
      sum += half[k] * (Eigen::Map<const Lanes>(center - k) + Eigen::Map<const Lanes>(center + k));
    }
    Eigen::Map<Lanes>(smooth.data() + std::min(c, last)) = sum;
  }
}

/// Finds peaks row by row and reuses its buffers.
class RowScanner {
 public:
  RowScanner(const Background& background, const PeakOptions& options, int columns)
      : background_(background),
        options_(options),
        half_(half_kernel(static_cast<float>(options.smoothing_sigma_px))),
        columns_(columns),
        smooth_(static_cast<std::size_t>((columns + kLanes - 1) / kLanes * kLanes), 0.0F) {
    float energy = -half_[0] * half_[0];
    for (const float weight : half_) energy += 2.0F * weight * weight;
    threshold_ = static_cast<float>(options.threshold) * std::sqrt(energy);
  }

  /// The peaks of a row, valid until the next call.
  std::span<const Peak> scan(const cv::Mat& rows, int r) {
    const std::span<const float> row(rows.ptr<float>(r), static_cast<std::size_t>(rows.cols));
    smooth_row(row, half_, smooth_);
    peaks_.clear();
    found_.clear();
    find_maxima(r);
    for (const Maximum& maximum : maxima_) add_peak(row, r, maximum.column, maximum.level);
    measure_room();
    return peaks_;
  }

 private:
  /// Where the smoothed row is brighter than its neighbors and than noise.
  struct Maximum {
    int column = 0;
    float level = 0;  ///< of the background there
  };

  void find_maxima(int r) {
    maxima_.clear();
    const float* smooth = smooth_.data();
    for (int begin = 0; begin < columns_; begin += kLanes) {
      const float level = background_.level(r, begin);
      const float least = level + threshold_ * background_.noise(r, begin);
      // The buffer has whole blocks; the part beyond the row is zero.
      const Eigen::Map<const Lanes> block(smooth + begin);
      if (!((block - least).max(0.0F).sum() > 0)) continue;
      const int end = std::min(begin + kLanes, columns_ - 1);
      for (int c = std::max(begin, 1); c < end; ++c) {
        if (smooth[c] > least && smooth[c] >= smooth[c - 1] && smooth[c] > smooth[c + 1]) {
          maxima_.push_back({c, level});
        }
      }
    }
  }

  void add_peak(std::span<const float> row, int r, int column, float level) {
    const auto flanks = find_flanks(column, level);
    if (!flanks) return;
    if (!found_.empty() && is_split(found_.back(), *flanks)) {
      if (smooth(column) <= smooth(found_.back().column)) return;
      peaks_.pop_back();
      found_.pop_back();
    }
    auto peak = measure(*flanks, level);
    if (!peak) return;
    peak->row = r;
    peak->saturated = row[static_cast<std::size_t>(column)] >= options_.full_scale;
    peaks_.push_back(*peak);
    found_.push_back(*flanks);
  }

  [[nodiscard]] float smooth(int column) const { return smooth_[static_cast<std::size_t>(column)]; }

  /// A maximum and the positions of its two flanks.
  struct Flanks {
    int column = 0;
    float left = 0, right = 0;
  };

  [[nodiscard]] std::optional<Flanks> find_flanks(int column, float level) const {
    const float flank = level + kFlankLevel * (smooth(column) - level);
    const auto left = crossing(column, -1, flank), right = crossing(column, 1, flank);
    if (!left || !right) return std::nullopt;
    return Flanks{column, *left, *right};
  }

  /// True if the valley between two maxima is too shallow: the flank of the lower maximum is beyond
  /// the higher one.
  [[nodiscard]] bool is_split(const Flanks& left, const Flanks& right) const {
    return smooth(left.column) < smooth(right.column)
               ? left.right > static_cast<float>(right.column)
               : right.left < static_cast<float>(left.column);
  }

  /// Position and width from the flanks.
  [[nodiscard]] std::optional<Peak> measure(const Flanks& flanks, float level) const {
    const float total = (flanks.right - flanks.left) / kFlankDistance;
    const auto smoothing = static_cast<float>(options_.smoothing_sigma_px);
    const float variance = total * total - smoothing * smoothing;
    if (!(variance > kMinVariance)) return std::nullopt;
    Peak peak;
    peak.center_px = 0.5F * (flanks.left + flanks.right);
    if (options_.three_point) {
      peak.three_point_px =
          static_cast<float>(flanks.column) + three_point_offset(flanks.column, level);
    }
    peak.sigma_px = std::sqrt(variance);
    peak.amplitude = (smooth(flanks.column) - level) * total / peak.sigma_px;
    return peak;
  }

  /// Where the smoothed row falls below `flank`, from `column` in the direction of `step`.
  [[nodiscard]] std::optional<float> crossing(int column, int step, float flank) const {
    int c = column + step;
    while (c >= 0 && c < columns_ && smooth(c) > flank) c += step;
    if (c < 0 || c >= columns_) return std::nullopt;
    const float share = (smooth(c - step) - flank) / (smooth(c - step) - smooth(c));
    return static_cast<float>(c - step) + share * static_cast<float>(step);
  }

  /// Center of the Gaussian through three neighboring values, relative to the middle one.
  [[nodiscard]] float three_point_offset(int column, float level) const {
    const float left = smooth(column - 1) - level, right = smooth(column + 1) - level;
    if (!(left > 0 && right > 0)) return 0.0F;
    const float a = std::log(left), b = std::log(smooth(column) - level), c = std::log(right);
    const float curvature = 2.0F * b - a - c;
    return curvature > 0 ? 0.5F * (c - a) / curvature : 0.0F;
  }

  void measure_room() {
    for (Peak& peak : peaks_) peak.room_px = std::numeric_limits<float>::max();
    for (std::size_t i = 1; i < peaks_.size(); ++i) {
      const float half = 0.5F * (peaks_[i].center_px - peaks_[i - 1].center_px);
      peaks_[i - 1].room_px = std::min(peaks_[i - 1].room_px, half);
      peaks_[i].room_px = half;
    }
  }

  const Background& background_;
  const PeakOptions& options_;
  std::vector<float> half_;
  float threshold_ = 0;  // in standard deviations of a single pixel
  int columns_;
  std::vector<float> smooth_;  // the smoothed row, padded with zeros to whole blocks
  std::vector<Maximum> maxima_;
  std::vector<Peak> peaks_;
  std::vector<Flanks> found_;  // parallel to peaks_
};

}  // namespace

PeakRows find_peaks(const cv::Mat& rows, const Background& background, const PeakOptions& options) {
  RowScanner scanner(background, options, rows.cols);
  PeakRows peaks;
  for (int r = 0; r < rows.rows; ++r) peaks.add_row(scanner.scan(rows, r));
  return peaks;
}

}  // namespace flytri::localization
