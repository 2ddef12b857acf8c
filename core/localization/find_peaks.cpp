#include "core/localization/find_peaks.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

namespace flytri {
namespace {

using RowArray = Eigen::ArrayXf;

constexpr int kBlock = 32;  // columns that are skipped at once where nothing is bright
/// Flanks are taken, and two maxima are two lines, where the light falls to this share of the top.
/// Two equal Gaussians 1.2 widths apart have a valley of 0.74.
constexpr float kFlankLevel = 0.7F;
constexpr float kFlankDistance = 1.6892F;  // between the flanks of a Gaussian, in sigmas
constexpr float kMinVariance = 0.05F;      // px^2; narrower is a hot pixel, not an imaged line

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

/// Smooths one row. The ends, where the kernel does not fit, stay zero.
void smooth_row(std::span<const float> row, std::span<const float> half, RowArray& smooth) {
  const auto radius = static_cast<Eigen::Index>(half.size()) - 1;
  const auto columns = static_cast<Eigen::Index>(row.size());
  const Eigen::Map<const RowArray> values(row.data(), columns);
  smooth.setZero(columns);
  const Eigen::Index inner = columns - 2 * radius;
  if (inner <= 0) return;
  auto out = smooth.segment(radius, inner);
  out = half[0] * values.segment(radius, inner);
  for (Eigen::Index k = 1; k <= radius; ++k) {
    out += half[static_cast<std::size_t>(k)] *
           (values.segment(radius - k, inner) + values.segment(radius + k, inner));
  }
}

/// Finds peaks row by row with buffers that are kept.
class RowScanner {
 public:
  RowScanner(const Background& background, const PeakOptions& options)
      : background_(background),
        options_(options),
        half_(half_kernel(static_cast<float>(options.smoothing_sigma_px))) {
    float energy = -half_[0] * half_[0];
    for (const float weight : half_) energy += 2.0F * weight * weight;
    threshold_ = static_cast<float>(options.threshold) * std::sqrt(energy);
  }

  std::vector<Peak> scan(const cv::Mat& rows, int r) {
    const std::span<const float> row(rows.ptr<float>(r), static_cast<std::size_t>(rows.cols));
    smooth_row(row, half_, smooth_);
    peaks_.clear();
    found_.clear();
    for (int begin = 0; begin < rows.cols; begin += kBlock) {
      const float level = background_.level(r, begin);
      const float least = level + threshold_ * background_.noise(r, begin);
      const int end = std::min(begin + kBlock, rows.cols);
      if (smooth_.segment(begin, end - begin).maxCoeff() <= least) continue;
      const float* smooth = smooth_.data();
      for (int c = std::max(begin, 1); c < std::min(end, rows.cols - 1); ++c) {
        if (smooth[c] > least && smooth[c] >= smooth[c - 1] && smooth[c] > smooth[c + 1]) {
          add_peak(row, r, c, level);
        }
      }
    }
    measure_room();
    return peaks_;
  }

 private:
  void add_peak(std::span<const float> row, int r, int column, float level) {
    const auto flanks = find_flanks(column, level);
    if (!flanks) return;
    if (!found_.empty() && is_split(found_.back(), *flanks)) {
      if (smooth_[column] <= smooth_[found_.back().column]) return;
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

  /// A maximum and where its light has fallen to the flank level on both sides.
  struct Flanks {
    int column = 0;
    float left = 0, right = 0;
  };

  [[nodiscard]] std::optional<Flanks> find_flanks(int column, float level) const {
    const float flank = level + kFlankLevel * (smooth_[column] - level);
    const auto left = crossing(column, -1, flank), right = crossing(column, 1, flank);
    if (!left || !right) return std::nullopt;
    return Flanks{column, *left, *right};
  }

  /// True if there is hardly a valley between two maxima: the lower one's flank is beyond the
  /// other.
  [[nodiscard]] bool is_split(const Flanks& left, const Flanks& right) const {
    return smooth_[left.column] < smooth_[right.column]
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
    peak.three_point_px =
        static_cast<float>(flanks.column) + three_point_offset(flanks.column, level);
    peak.sigma_px = std::sqrt(variance);
    peak.amplitude = (smooth_[flanks.column] - level) * total / peak.sigma_px;
    return peak;
  }

  /// Where the smoothed row falls below `flank`, from `column` in the direction of `step`.
  [[nodiscard]] std::optional<float> crossing(int column, int step, float flank) const {
    const int size = static_cast<int>(smooth_.size());
    int c = column + step;
    while (c >= 0 && c < size && smooth_[c] > flank) c += step;
    if (c < 0 || c >= size) return std::nullopt;
    const float share = (smooth_[c - step] - flank) / (smooth_[c - step] - smooth_[c]);
    return static_cast<float>(c - step) + share * static_cast<float>(step);
  }

  /// Center of the Gaussian through three neighboring values, relative to the middle one.
  [[nodiscard]] float three_point_offset(int column, float level) const {
    const float left = smooth_[column - 1] - level, right = smooth_[column + 1] - level;
    if (!(left > 0 && right > 0)) return 0.0F;
    const float a = std::log(left), b = std::log(smooth_[column] - level), c = std::log(right);
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
  RowArray smooth_;
  std::vector<Peak> peaks_;
  std::vector<Flanks> found_;  // parallel to peaks_
};

}  // namespace

std::vector<std::vector<Peak>> find_peaks(const cv::Mat& rows, const Background& background,
                                          const PeakOptions& options) {
  RowScanner scanner(background, options);
  std::vector<std::vector<Peak>> peaks;
  peaks.reserve(static_cast<std::size_t>(rows.rows));
  for (int r = 0; r < rows.rows; ++r) peaks.push_back(scanner.scan(rows, r));
  return peaks;
}

}  // namespace flytri
