#include "hw/sync/latency_filter.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/base/check_options.h"

namespace flytri::sync {
namespace {

constexpr int kStepsPerPeriod = 32;
/// Half lengths of the considered exposure windows, in grid steps; up to 1.5 periods in total.
constexpr std::array kHalfWindows = {1, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24};
constexpr int kMaxHalfWindow = kHalfWindows.back();

// Share of a frame's light from which it counts as one light alone; allows for rounding of the
// grid.
constexpr double kAlone = 0.98;
constexpr double kNearlyAlone = 0.9;

// Smallest probability: after a jump of the latency, about twelve images find the new value.
constexpr double kLeast = 1e-12;

// The least for "unexplained": about a second of images must contradict a latency that was known.
constexpr double kLeastUnexplained = 1e-40;

// The latency is known while "swapped patterns" and "unexplained" are at most this likely. One
// misleading image makes "unexplained" rise a little; frames must keep their labels then.
constexpr double kMostSwapped = 0.01, kMostUnexplained = 1e-4;

/// From 0 (no flash in the exposure) to 1 (the flash outshines all other light).
double flash_visibility(double flash_share) { return std::min(1.0, flash_share / 0.3); }

/// The mean of exp(-(x - m)^2 / 2 sigma^2) over m from `low` to `high`.
double mean_of_bell(double x, double low, double high, double sigma) {
  const double scale = 1.0 / (std::numbers::sqrt2 * sigma);
  const double width = (high - low) * scale;
  // Narrow interval: the difference of error functions would lose precision.
  if (width < 1e-3) return std::exp(-std::pow((x - 0.5 * (low + high)) * scale, 2));
  const double integral = std::erf((high - x) * scale) - std::erf((low - x) * scale);
  return 0.5 * std::sqrt(std::numbers::pi) * integral / width;
}

LightTimes difference(const LightTimes& end, const LightTimes& begin) {
  LightTimes times;
  for (std::size_t light = 0; light < kLightCount; ++light)
    times.lit_s[light] = end.lit_s[light] - begin.lit_s[light];
  times.changing_s = end.changing_s - begin.changing_s;
  return times;
}

void swap_patterns(LightTimes& times) {
  std::swap(times.lit_s[at(device::Light::kVertical)], times.lit_s[at(device::Light::kHorizontal)]);
}

}  // namespace

Result<void> LatencyOptions::validate() const {
  return OptionCheck("LatencyOptions")
      .positive("frame_period_s", frame_period_s)
      .in_range("min_latency_periods", min_latency_periods, -4.0, 0.0)
      .in_range("max_latency_periods", max_latency_periods, 1.0, 32.0)
      .not_negative("min_window_s", min_window_s)
      .in_range("outlier_share", outlier_share, 0.0, 0.5)
      .positive("share_sigma", share_sigma)
      .not_negative("few_line_places", few_line_places)
      .in_range("drift", drift, 0.0, 0.1)
      .result();
}

LatencyFilter::LatencyFilter(const LatencyOptions& options)
    : options_(options), step_s_(options.frame_period_s / kStepsPerPeriod) {
  const double periods = options.max_latency_periods - options.min_latency_periods;
  latency_count_ = static_cast<std::size_t>(std::lround(periods * kStepsPerPeriod)) + 1;
  // If the camera's exposure is longer than all windows, keep the longest.
  while (first_window_ + 1 < kHalfWindows.size() &&
         window_s(first_window_) < options.min_window_s - step_s_)
    ++first_window_;
  probability_.assign(2 * kHalfWindows.size() * latency_count_, 0.0);
  for (std::size_t cell = 0; cell < probability_.size(); ++cell)
    if (is_possible(cell)) probability_[cell] = 1.0;
  unexplained_ = std::accumulate(probability_.begin(), probability_.end(), 0.0);
  normalize();
}

double LatencyFilter::latency_s(std::size_t place) const {
  return options_.min_latency_periods * options_.frame_period_s +
         static_cast<double>(place) * step_s_;
}

std::size_t LatencyFilter::window_of(std::size_t cell) const {
  return cell / latency_count_ % kHalfWindows.size();
}

double LatencyFilter::window_s(std::size_t window) const {
  return 2.0 * kHalfWindows[window] * step_s_;
}

template <typename Use>
void LatencyFilter::visit(const LightHistory& history, double stamp_s, const Use& use) const {
  // Running sums over all times at which light may have reached the frame.
  const auto last = static_cast<int>(latency_count_) - 1;
  const double start_s =
      stamp_s - latency_s(latency_count_ - 1) - static_cast<double>(kMaxHalfWindow) * step_s_;
  const std::vector<LightTimes> sums =
      history.running_times(start_s, step_s_, last + 2 * kMaxHalfWindow);
  std::size_t cell = 0;
  for (const bool swapped : {false, true}) {
    for (std::size_t w = 0; w < kHalfWindows.size(); ++w) {
      for (std::size_t place = 0; place < latency_count_; ++place) {
        const std::size_t middle = latency_count_ - 1 - place + std::size_t{kMaxHalfWindow};
        const auto half = static_cast<std::size_t>(kHalfWindows[w]);
        LightTimes times = difference(sums[middle + half], sums[middle - half]);
        if (swapped) swap_patterns(times);
        use(cell++, times, window_s(w));
      }
    }
  }
}

LightPrediction LatencyFilter::predict(const LightHistory& history, double stamp_s) const {
  LightPrediction prediction;
  std::array<double, kLightCount> squares = {};
  visit(history, stamp_s, [&](std::size_t cell, const LightTimes& times, double window_s) {
    const double p = probability_[cell];
    const double latency = latency_s(cell % latency_count_);
    for (std::size_t light = 0; light < kLightCount; ++light) {
      const double share = times.lit_s[light] / window_s;
      if (share >= kNearlyAlone) prediction.nearly_alone[light] += p;
      if (share < kAlone) continue;
      prediction.alone[light] += p;
      prediction.latency_s[light] += p * latency;
      squares[light] += p * latency * latency;
    }
  });
  for (std::size_t light = 0; light < kLightCount; ++light) {
    if (prediction.alone[light] <= 0.0) continue;
    const double mean = prediction.latency_s[light] /= prediction.alone[light];
    const double variance = squares[light] / prediction.alone[light] - mean * mean;
    prediction.latency_sigma_s[light] = std::sqrt(std::max(0.0, variance));
  }
  return prediction;
}

double LatencyFilter::likelihood(const LightTimes& times, double window_s,
                                 const LightEvidence& evidence) const {
  const auto share = [&](double time_s) { return time_s / window_s; };
  const double changing = share(times.changing_s);
  const double outlier = options_.outlier_share;
  // During a device call, either light may be on: assume the one that fits better.
  const double flash = share(times.lit(device::Light::kFlash));
  if (evidence.is_flash) return outlier + (1.0 - outlier) * flash_visibility(flash + changing);
  // No object in front of the sensor, or dark. A flash is visible from farthest away.
  if (!evidence.has_lines)
    return 0.6 + 0.4 * share(times.lit(device::Light::kDark)) - 0.4 * flash_visibility(flash);
  const double vertical = share(times.lit(device::Light::kVertical));
  const double lines = vertical + share(times.lit(device::Light::kHorizontal)) + changing;
  if (lines < 0.1) return outlier;
  const double sigma =
      options_.share_sigma * (1.0 + options_.few_line_places / evidence.line_places);
  return outlier + (1.0 - outlier) * (1.0 - flash_visibility(flash)) *
                       mean_of_bell(evidence.column_share, vertical / lines,
                                    (vertical + changing) / lines, sigma);
}

void LatencyFilter::learn(const LightHistory& history, double stamp_s,
                          const LightEvidence& evidence) {
  drift();
  std::vector<double> likelihoods(probability_.size());
  visit(history, stamp_s, [&](std::size_t cell, const LightTimes& times, double window_s) {
    likelihoods[cell] = likelihood(times, window_s, evidence);
  });
  learn_of_unexplained(likelihoods, !evidence.is_empty());
  for (std::size_t cell = 0; cell < probability_.size(); ++cell)
    probability_[cell] *= likelihoods[cell];
  normalize();
}

// An image of any other time is as likely as the mean over all cells. An image without light tells
// nothing: with no object in view, all images are alike, and the latency must stay known.
void LatencyFilter::learn_of_unexplained(std::span<const double> likelihoods, bool shows_light) {
  double sum = 0.0, weights = 0.0;
  for (std::size_t cell = 0; cell < likelihoods.size(); ++cell) {
    if (!is_possible(cell)) continue;
    const double weight = shows_light ? 1.0 : probability_[cell];
    sum += weight * likelihoods[cell];
    weights += weight;
  }
  unexplained_ *= sum / weights;
}

void LatencyFilter::normalize() {
  const double sum = std::accumulate(probability_.begin(), probability_.end(), unexplained_);
  for (std::size_t cell = 0; cell < probability_.size(); ++cell)
    if (is_possible(cell)) probability_[cell] = std::max(probability_[cell] / sum, kLeast);
  unexplained_ = std::max(unexplained_ / sum, kLeastUnexplained);
}

void LatencyFilter::drift() {
  for (auto row = probability_.begin(); row != probability_.end();) {
    const auto end = row + static_cast<std::ptrdiff_t>(latency_count_);
    double before = *row;
    for (auto cell = row; cell != end; ++cell) {
      const double after = cell + 1 != end ? *(cell + 1) : *cell;
      const double here = *cell;
      *cell += options_.drift * (before + after - 2.0 * here);
      before = here;
    }
    row = end;
  }
}

LatencyEstimate LatencyFilter::estimate() const {
  LatencyEstimate estimate;
  double latency_square = 0.0, sum = 0.0;
  const std::size_t per_mapping = kHalfWindows.size() * latency_count_;
  for (std::size_t cell = 0; cell < probability_.size(); ++cell) {
    const double p = probability_[cell];
    const double latency = latency_s(cell % latency_count_);
    sum += p;
    estimate.latency_s += p * latency;
    latency_square += p * latency * latency;
    estimate.window_s += p * window_s(window_of(cell));
    if (cell >= per_mapping) estimate.swapped += p;
  }
  estimate.latency_s /= sum;
  estimate.window_s /= sum;
  estimate.swapped /= sum;
  estimate.unexplained = unexplained_ / (sum + unexplained_);
  const double variance = latency_square / sum - estimate.latency_s * estimate.latency_s;
  estimate.latency_sigma_s = std::sqrt(std::max(0.0, variance));
  return estimate;
}

bool LatencyFilter::is_learned() const {
  const LatencyEstimate now = estimate();
  const bool is_sure = now.swapped < kMostSwapped || now.swapped > 1.0 - kMostSwapped;
  return is_sure && now.unexplained < kMostUnexplained &&
         now.latency_sigma_s < options_.frame_period_s / 16.0;
}

}  // namespace flytri::sync
