#include "core/localization/refine_traces.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "core/base/median.h"
#include "core/localization/estimate_noise.h"
#include "core/localization/fit_line.h"
#include "core/localization/level_under_line.h"

namespace flytri::localization {
namespace {

constexpr float kFwhmOfSigma = 2.3548F;
/// A fit uses this many sigmas on each side. At 0.7 of this distance, the weight has decreased to a
/// quarter.
constexpr float kReachSigmas = 4.0F;
/// If the next line is closer than this, too little of the flanks is visible.
constexpr float kMinReachSigmas = 1.5F;
/// Speckle contrast assumed before the noise of the image is known; typical for the sensors of the
/// paper.
constexpr float kFirstContrast = 0.1F;
constexpr std::size_t kShapeStep = 4;   // the shape is fitted to every fourth peak
constexpr std::size_t kShapeBlock = 2;  // fitted shapes between two knots of the smoothed shape

/// What changes slowly along a line: its width and the background under it.
struct LineShape {
  float sigma_px = 0;
  FlankLevel background;
};

/// A fit and the background that it stands on.
struct ShapeFit {
  LineFit line;
  FlankLevel background;
};

/// Fits along one trace; nullopt where the fit failed.
using TraceFits = std::vector<std::optional<ShapeFit>>;

/// Medians of the shape over overlapping blocks of fits. The knots are kShapeBlock fits apart.
std::vector<LineShape> shape_knots(const TraceFits& fits) {
  std::vector<LineShape> knots;
  std::vector<float> sigma, level, slope;
  for (std::size_t at = 0; at < fits.size() + 2 * kShapeBlock; at += kShapeBlock) {
    sigma.clear(), level.clear(), slope.clear();
    const std::size_t first = at < kShapeBlock ? 0 : at - kShapeBlock;
    for (std::size_t i = first; i < std::min(at + kShapeBlock + 1, fits.size()); ++i) {
      if (!fits[i]) continue;
      sigma.push_back(fits[i]->line.sigma_px);
      level.push_back(fits[i]->background.level);
      slope.push_back(fits[i]->background.slope);
    }
    if (!sigma.empty()) {
      knots.push_back({median_of(sigma), {median_of(level), median_of(slope)}});
    } else {
      knots.push_back(knots.empty() ? LineShape{} : knots.back());
    }
  }
  return knots;
}

/// The shape at a peak, interpolated between two knots.
LineShape shape_at(const std::vector<LineShape>& knots, std::size_t peak) {
  constexpr std::size_t kSpan = kShapeBlock * kShapeStep;
  const LineShape &a = knots[peak / kSpan], &b = knots[peak / kSpan + 1];
  const float share = static_cast<float>(peak % kSpan) / kSpan;
  const auto mix = [share](float left, float right) { return left + share * (right - left); };
  return {
      mix(a.sigma_px, b.sigma_px),
      {mix(a.background.level, b.background.level), mix(a.background.slope, b.background.slope)}};
}

class Refiner {
 public:
  Refiner(const cv::Mat& rows, const Background& background, const RefineOptions& options)
      : rows_(rows), background_(background), options_(options) {}

  /// Fits of position, height and width to every kShapeStep-th peak.
  [[nodiscard]] TraceFits fit_shapes(const PeakTrace& trace) const {
    NoiseModel noise;
    noise.speckle_contrast = kFirstContrast;
    TraceFits fits;
    for (std::size_t i = 0; i < trace.size(); i += kShapeStep) {
      const Peak& peak = trace[i];
      const LineFit start{peak.center_px, peak.sigma_px, peak.amplitude, 0.0F};
      const auto flank = level_under_line(rows_, peak.row, start, background_, options_.is_dense);
      noise.read_variance = std::pow(background_.noise(peak.row, int(peak.center_px)), 2.0F);
      std::optional<LineFit> line;
      if (flank) line = fit(peak, start, *flank, noise, true);
      fits.push_back(line ? std::optional(ShapeFit{*line, *flank}) : std::nullopt);
    }
    return fits;
  }

  /// The final fit, with the shape of the trace.
  [[nodiscard]] LineTrace fit_positions(const PeakTrace& trace, const TraceFits& fits,
                                        const NoiseModel& noise) const {
    LineTrace samples;
    const std::vector<LineShape> knots = shape_knots(fits);
    for (std::size_t i = 0; i < trace.size(); ++i) {
      const Peak& peak = trace[i];
      const LineShape shape = shape_at(knots, i);
      if (!(shape.sigma_px > 0)) continue;
      // Every fourth peak already has a fit, which is more accurate than the peak itself.
      const bool fitted = i % kShapeStep == 0 && fits[i / kShapeStep];
      const LineFit near =
          fitted ? fits[i / kShapeStep]->line : LineFit{peak.center_px, 0.0F, peak.amplitude, 0.0F};
      const LineFit start{near.center_px, shape.sigma_px, near.amplitude, 0.0F};
      const auto line = fit(peak, start, shape.background, noise, false);
      if (!line) continue;
      const bool three_point = options_.estimator == LineEstimator::kThreePoint;
      samples.push_back({peak.row, three_point ? peak.three_point_px : line->center_px,
                         kFwhmOfSigma * line->sigma_px, line->amplitude,
                         std::sqrt(line->center_variance), peak.saturated});
    }
    return samples;
  }

 private:
  [[nodiscard]] std::span<const float> row_of(const Peak& peak) const {
    return {rows_.ptr<float>(peak.row), static_cast<std::size_t>(rows_.cols)};
  }

  [[nodiscard]] std::optional<LineFit> fit(const Peak& peak, const LineFit& start,
                                           const FlankLevel& flank, const NoiseModel& noise,
                                           bool fit_width) const {
    const float reach = std::min(kReachSigmas * start.sigma_px, peak.room_px);
    if (reach < kMinReachSigmas * start.sigma_px) return std::nullopt;
    const LineWindow window{row_of(peak), flank, reach, options_.full_scale};
    // The start values of a clipped line are inaccurate.
    const int max_steps = peak.saturated ? 6 : 2;
    return fit_line(window, noise, start, fit_width, max_steps);
  }

  const cv::Mat& rows_;
  const Background& background_;
  const RefineOptions& options_;
};

/// The noise model of the image, from some of the fits.
NoiseModel noise_of(const cv::Mat& rows, const Background& background,
                    const std::vector<PeakTrace>& traces, const std::vector<TraceFits>& fits,
                    const RefineOptions& options) {
  constexpr std::size_t kNoiseStep = 2;  // every second fit is enough to estimate the noise
  FittedLines some;
  std::size_t counter = 0;
  for (std::size_t t = 0; t < traces.size(); ++t) {
    for (std::size_t i = 0; i < fits[t].size(); ++i) {
      if (!fits[t][i] || counter++ % kNoiseStep != 0) continue;
      some.fits.push_back(fits[t][i]->line);
      some.rows.push_back(traces[t][i * kShapeStep].row);
    }
  }
  return estimate_noise(rows, background, some, options.full_scale, options.is_dense);
}

}  // namespace

std::vector<LineTrace> refine_traces(const cv::Mat& rows, const Background& background,
                                     const std::vector<PeakTrace>& traces,
                                     const RefineOptions& options) {
  const Refiner refiner(rows, background, options);
  std::vector<TraceFits> fits;
  fits.reserve(traces.size());
  for (const PeakTrace& trace : traces) fits.push_back(refiner.fit_shapes(trace));
  const NoiseModel noise = noise_of(rows, background, traces, fits, options);
  std::vector<LineTrace> samples;
  for (std::size_t t = 0; t < traces.size(); ++t) {
    LineTrace trace = refiner.fit_positions(traces[t], fits[t], noise);
    if (!trace.empty()) samples.push_back(std::move(trace));
  }
  const float ratio = scatter_ratio(samples);
  for (LineTrace& trace : samples) {
    for (LineSample& sample : trace) sample.sigma_px *= ratio;
  }
  return samples;
}

}  // namespace flytri::localization
