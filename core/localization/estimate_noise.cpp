#include "core/localization/estimate_noise.h"

#include <algorithm>
#include <cmath>

#include "core/base/median.h"
#include "core/localization/level_under_line.h"

namespace flytri::localization {
namespace {

constexpr float kMaxContrast = 0.5F;

/// Median background noise of the tiles that the lines cross.
float read_variance(const Background& background, const FittedLines& lines) {
  std::vector<float> noise;
  for (std::size_t i = 0; i < lines.fits.size(); ++i) {
    noise.push_back(background.noise(lines.rows[i], static_cast<int>(lines.fits[i].center_px)));
  }
  const float median = median_of(noise);
  return median * median;
}

}  // namespace

NoiseModel estimate_noise(const cv::Mat& rows, const Background& background,
                          const FittedLines& lines, float full_scale, bool is_dense) {
  NoiseModel noise;
  if (lines.fits.empty()) return noise;
  noise.read_variance = read_variance(background, lines);
  // Squared residual minus reading noise = gain * signal + contrast^2 * signal^2, divided by the
  // signal, so that each pixel has a similar weight. This is a straight line in the signal.
  double n = 0, sum_s = 0, sum_ss = 0, sum_q = 0, sum_qs = 0;
  for (std::size_t i = 0; i < lines.fits.size(); ++i) {
    const LineFit& fit = lines.fits[i];
    const float* row = rows.ptr<float>(lines.rows[i]);
    const auto flank = level_under_line(rows, lines.rows[i], fit, background, is_dense);
    if (!flank) continue;
    const int first = std::max(static_cast<int>(std::ceil(fit.center_px - 1.8F * fit.sigma_px)), 0);
    const int last =
        std::min(static_cast<int>(std::floor(fit.center_px + 1.8F * fit.sigma_px)), rows.cols - 1);
    for (int c = first; c <= last; ++c) {
      if (row[c] >= full_scale) continue;
      const float t = static_cast<float>(c) - fit.center_px;
      const float signal = fit.amplitude * std::exp(-0.5F * t * t / (fit.sigma_px * fit.sigma_px));
      const float residual = row[c] - flank->level - flank->slope * t - signal;
      const double q = (residual * residual - noise.read_variance) / signal;
      n += 1;
      sum_s += signal;
      sum_ss += double(signal) * signal;
      sum_q += q;
      sum_qs += q * signal;
    }
  }
  const double determinant = n * sum_ss - sum_s * sum_s;
  if (!(determinant > 1e-9 * n * sum_ss)) return noise;
  double gain = (sum_ss * sum_q - sum_s * sum_qs) / determinant;
  double contrast2 = (n * sum_qs - sum_s * sum_q) / determinant;
  if (contrast2 < 0) {  // no speckle: shot noise alone
    contrast2 = 0;
    gain = sum_q / n;
  } else if (gain < 0) {
    gain = 0;
    contrast2 = sum_qs / sum_ss;
  }
  noise.shot_gain = static_cast<float>(std::max(gain, 0.0));
  noise.speckle_contrast =
      std::min(static_cast<float>(std::sqrt(std::max(contrast2, 0.0))), kMaxContrast);
  return noise;
}

float scatter_ratio(const std::vector<LineTrace>& traces) {
  constexpr std::size_t kLag = 4;  // rows; farther apart than the size of a speckle
  constexpr std::size_t kMinCount = 100;
  std::vector<float> ratios;
  for (const LineTrace& trace : traces) {
    for (std::size_t i = 0; i + 3 * kLag < trace.size(); i += 2) {
      const LineSample &a = trace[i], &b = trace[i + kLag], &c = trace[i + 2 * kLag],
                       &d = trace[i + 3 * kLag];
      if (d.along_px - a.along_px != 3 * static_cast<int>(kLag)) continue;
      const float difference = d.across_px - a.across_px - 3.0F * (c.across_px - b.across_px);
      const float variance = a.sigma_px * a.sigma_px + d.sigma_px * d.sigma_px +
                             9.0F * (b.sigma_px * b.sigma_px + c.sigma_px * c.sigma_px);
      ratios.push_back(std::abs(difference) / std::sqrt(variance));
    }
  }
  if (ratios.size() < kMinCount) return 1.0F;
  return median_of(ratios) / static_cast<float>(kMedianOfSigma);
}

}  // namespace flytri::localization
