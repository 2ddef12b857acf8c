#include "core/localization/find_peaks.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <span>

#include "core/localization/fit_peak.h"

namespace flytri {
namespace {

using RowArray = Eigen::ArrayXf;

constexpr int kBlock = 32;  // columns that are skipped at once where nothing is bright
constexpr float kFwhmOfSigma = 2.3548F;

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
      : background_(background), options_(options) {
    half_ = kernels_.half(static_cast<float>(options.smoothing_sigma_px));
    float energy = -half_[0] * half_[0];
    for (const float weight : half_) energy += 2.0F * weight * weight;
    noise_gain_ = std::sqrt(energy);
  }

  std::vector<LineSample> scan(const cv::Mat& rows, int r) {
    const std::span<const float> row(rows.ptr<float>(r), static_cast<std::size_t>(rows.cols));
    smooth_row(row, half_, smooth_);
    std::vector<LineSample> peaks;
    for (int begin = 0; begin < rows.cols; begin += kBlock) {
      const float threshold = background_.level(r, begin) + static_cast<float>(options_.threshold) *
                                                                noise_gain_ *
                                                                background_.noise(r, begin);
      const int end = std::min(begin + kBlock, rows.cols);
      if (smooth_.segment(begin, end - begin).maxCoeff() <= threshold) continue;
      for (int c = std::max(begin, 1); c < std::min(end, rows.cols - 1); ++c) {
        if (smooth_[c] > threshold && smooth_[c] >= smooth_[c - 1] && smooth_[c] > smooth_[c + 1]) {
          add_peak(row, r, c, peaks);
        }
      }
    }
    return peaks;
  }

 private:
  void add_peak(std::span<const float> row, int r, int c, std::vector<LineSample>& peaks) const {
    const auto fit = fit_peak(row, c, background_.level(r, c), kernels_,
                              static_cast<float>(options_.smoothing_sigma_px));
    if (!fit) return;
    LineSample sample;
    sample.along_px = r;
    sample.across_px = fit->center_px;
    sample.width_px = kFwhmOfSigma * fit->sigma_px;
    sample.amplitude = fit->amplitude;
    sample.saturated = row[static_cast<std::size_t>(c)] >= options_.full_scale;
    sample.sigma_px = background_.noise(r, c) / fit->amplitude * std::sqrt(fit->sigma_px);
    if (!peaks.empty() && sample.across_px - peaks.back().across_px < 1.0F) return;
    peaks.push_back(sample);
  }

  const Background& background_;
  const PeakOptions& options_;
  GaussianKernels kernels_;
  std::span<const float> half_;
  float noise_gain_ = 1.0F;
  RowArray smooth_;
};

}  // namespace

std::vector<std::vector<LineSample>> find_peaks(const cv::Mat& rows, const Background& background,
                                                const PeakOptions& options) {
  RowScanner scanner(background, options);
  std::vector<std::vector<LineSample>> peaks;
  peaks.reserve(static_cast<std::size_t>(rows.rows));
  for (int r = 0; r < rows.rows; ++r) peaks.push_back(scanner.scan(rows, r));
  return peaks;
}

}  // namespace flytri
