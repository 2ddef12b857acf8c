#include "core/localization/refine_traces.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "core/localization/estimate_noise.h"
#include "core/localization/fit_line.h"

namespace flytri {
namespace {

constexpr float kFwhmOfSigma = 2.3548F;
/// A fit looks this many sigmas to each side; its weights have tapered to a quarter at 2.5.
constexpr float kReachSigmas = 3.6F;
/// With less room than this before the next line, too little of the flanks is left.
constexpr float kMinReachSigmas = 1.5F;
/// Before the image's noise is known: the paper's sensors are limited by speckle of this order.
constexpr float kFirstContrast = 0.1F;
constexpr float kUnknownSigma = 2.0F;  // of a trace whose first fits all fail
constexpr std::size_t kWidthStep = 2;  // every second width is fitted
constexpr int kWidthBlock = 4;         // fitted widths between two knots of the smoothed width

/// Fits along one trace; where it was not possible there is none.
using TraceFits = std::vector<std::optional<LineFit>>;

class Refiner {
 public:
  Refiner(const cv::Mat& rows, const Background& background, float full_scale)
      : rows_(rows), background_(background), full_scale_(full_scale) {}

  /// Fits of position, height and width for every kWidthStep-th peak.
  [[nodiscard]] TraceFits fit_widths(const PeakTrace& trace) const {
    NoiseModel noise;
    noise.speckle_contrast = kFirstContrast;
    TraceFits fits;
    for (std::size_t i = 0; i < trace.size(); i += kWidthStep) {
      const Peak& peak = trace[i];
      noise.read_variance = std::pow(background_.noise(peak.row, int(peak.center_px)), 2.0F);
      fits.push_back(
          fit(peak, {peak.center_px, peak.sigma_px, peak.amplitude, 0.0F}, noise, true, 2));
    }
    return fits;
  }

  /// The final fit, with the width of the trace.
  [[nodiscard]] LineTrace fit_positions(const PeakTrace& trace, const TraceFits& fits,
                                        const NoiseModel& noise) const {
    LineTrace samples;
    const std::vector<float> widths = smooth_widths(fits, trace.size());
    for (std::size_t i = 0; i < trace.size(); ++i) {
      const Peak& peak = trace[i];
      const LineFit start{peak.center_px, widths[i], peak.amplitude, 0.0F};
      const auto line = fit(trace[i], start, noise, false, 2);
      if (!line) continue;
      samples.push_back({trace[i].row, line->center_px, kFwhmOfSigma * line->sigma_px,
                         line->amplitude, std::sqrt(line->center_variance), trace[i].saturated});
    }
    return samples;
  }

 private:
  [[nodiscard]] std::optional<LineFit> fit(const Peak& peak, const LineFit& start,
                                           const NoiseModel& noise, bool fit_width,
                                           int iterations) const {
    const std::span<const float> row(rows_.ptr<float>(peak.row),
                                     static_cast<std::size_t>(rows_.cols));
    const auto flank = flank_level(row, start);
    const float reach = std::min(kReachSigmas * start.sigma_px, peak.room_px);
    if (!flank || reach < kMinReachSigmas * start.sigma_px) return std::nullopt;
    return fit_line({row, *flank, reach, full_scale_}, noise, start, fit_width, iterations);
  }

  /// Medians of overlapping blocks, joined by straight lines.
  static std::vector<float> smooth_widths(const TraceFits& fits, std::size_t peak_count) {
    const int count = static_cast<int>(fits.size());
    std::vector<float> knots;
    std::vector<float> block;
    for (int at = 0; at < count + 2 * kWidthBlock; at += kWidthBlock) {
      block.clear();
      for (int i = std::max(at - kWidthBlock, 0); i < std::min(at + kWidthBlock + 1, count); ++i) {
        if (fits[std::size_t(i)]) block.push_back(fits[std::size_t(i)]->sigma_px);
      }
      const auto middle = block.begin() + static_cast<std::ptrdiff_t>(block.size() / 2);
      std::nth_element(block.begin(), middle, block.end());
      knots.push_back(block.empty() ? (knots.empty() ? kUnknownSigma : knots.back()) : *middle);
    }
    std::vector<float> widths;
    constexpr std::size_t kSpan = kWidthBlock * kWidthStep;
    for (std::size_t i = 0; i < peak_count; ++i) {
      const float share = static_cast<float>(i % kSpan) / kSpan;
      widths.push_back((1.0F - share) * knots[i / kSpan] + share * knots[i / kSpan + 1]);
    }
    return widths;
  }

  const cv::Mat& rows_;
  const Background& background_;
  float full_scale_;
};

}  // namespace

std::vector<LineTrace> refine_traces(const cv::Mat& rows, const Background& background,
                                     const std::vector<PeakTrace>& traces, float full_scale) {
  constexpr std::size_t kNoiseStep = 4;  // every fourth fit tells the noise well enough
  const Refiner refiner(rows, background, full_scale);
  std::vector<TraceFits> fits;
  std::vector<LineFit> some;
  std::vector<int> some_rows;
  std::size_t counter = 0;
  for (const PeakTrace& trace : traces) {
    fits.push_back(refiner.fit_widths(trace));
    for (std::size_t i = 0; i < fits.back().size(); ++i) {
      if (!fits.back()[i] || counter++ % kNoiseStep != 0) continue;
      some.push_back(*fits.back()[i]);
      some_rows.push_back(trace[i * kWidthStep].row);
    }
  }
  const NoiseModel noise = estimate_noise(rows, background, some, some_rows, full_scale);
  std::vector<LineTrace> samples;
  for (std::size_t t = 0; t < traces.size(); ++t) {
    samples.push_back(refiner.fit_positions(traces[t], fits[t], noise));
  }
  const float ratio = scatter_ratio(samples);
  for (LineTrace& trace : samples) {
    for (LineSample& sample : trace) sample.sigma_px *= ratio;
  }
  return samples;
}

}  // namespace flytri
