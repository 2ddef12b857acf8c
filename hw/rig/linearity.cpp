#include "hw/rig/linearity.h"

#include <algorithm>
#include <cmath>

namespace flytri::rig {
namespace {

constexpr double kSaturated = 0.95;
constexpr std::size_t kFewest = 4;
constexpr double kLeastFactor = 2.0;
constexpr double kLeastRange = 0.2;
/// Of the range of gray values. A gamma of 1.1 gives 0.017 over a factor of eight.
constexpr double kAllowed = 0.015;

/// y = offset + slope * x
struct Line {
  double offset = 0.0;
  double slope = 0.0;
};

template <typename X, typename Y>
Line fit_line(const std::vector<ExposureStep>& steps, const X& x, const Y& y) {
  double sum_x = 0.0, sum_y = 0.0, sum_xx = 0.0, sum_xy = 0.0;
  for (const ExposureStep& step : steps) {
    sum_x += x(step);
    sum_y += y(step);
    sum_xx += x(step) * x(step);
    sum_xy += x(step) * y(step);
  }
  const auto count = static_cast<double>(steps.size());
  const double slope = (count * sum_xy - sum_x * sum_y) / (count * sum_xx - sum_x * sum_x);
  return {(sum_y - slope * sum_x) / count, slope};
}

/// The black level is unknown, too: tries many, and returns the exponent of the best fit.
/// @param lowest  of the levels to try
double fit_gamma(const std::vector<ExposureStep>& steps, double lowest, double darkest) {
  double best = 1.0, least = 1e300;
  for (int i = 0; i < 100; ++i) {
    const double black = lowest + (darkest - lowest) * i / 100.0;
    const auto log_exposure = [](const ExposureStep& step) { return std::log(step.exposure_s); };
    const auto log_gray = [&](const ExposureStep& step) { return std::log(step.gray - black); };
    const Line line = fit_line(steps, log_exposure, log_gray);
    double square = 0.0;
    for (const ExposureStep& step : steps) {
      const double gray = black + std::exp(line.offset + line.slope * log_exposure(step));
      square += (gray - step.gray) * (gray - step.gray);
    }
    if (square >= least) continue;
    least = square;
    best = line.slope;
  }
  return best;
}

}  // namespace

Result<Linearity> judge_linearity(const std::vector<ExposureStep>& all) {
  std::vector<ExposureStep> steps;
  std::copy_if(all.begin(), all.end(), std::back_inserter(steps),
               [](const ExposureStep& step) { return step.gray < kSaturated && step.gray > 0.0; });
  if (steps.size() < kFewest)
    return fail(ErrorCode::kBadOption,
                "only {} of {} exposures are neither black nor overexposed, but {} are needed: "
                "choose a shorter exposure_s or a lower gain, or more light",
                steps.size(), all.size(), kFewest);
  const auto [darkest, brightest] = std::minmax_element(
      steps.begin(), steps.end(), [](const auto& a, const auto& b) { return a.gray < b.gray; });
  const auto [shortest, longest] =
      std::minmax_element(steps.begin(), steps.end(),
                          [](const auto& a, const auto& b) { return a.exposure_s < b.exposure_s; });
  const double range = brightest->gray - darkest->gray;
  if (longest->exposure_s < kLeastFactor * shortest->exposure_s || range < kLeastRange)
    return fail(ErrorCode::kBadOption,
                "the exposures change the gray value only by {:.0f} % of full scale: put a white "
                "sheet in front of the camera and use more light",
                100.0 * range);
  const auto exposure = [](const ExposureStep& step) { return step.exposure_s; };
  const Line line = fit_line(steps, exposure, [](const ExposureStep& step) { return step.gray; });
  Linearity linearity;
  linearity.black = line.offset;
  for (const ExposureStep& step : steps) {
    const double expected = line.offset + line.slope * step.exposure_s;
    linearity.deviation = std::max(linearity.deviation, std::abs(step.gray - expected) / range);
  }
  // A camera may cut off what is below its black level.
  linearity.gamma = fit_gamma(steps, std::min(0.0, linearity.black), darkest->gray);
  linearity.is_linear = linearity.deviation <= kAllowed;
  return linearity;
}

}  // namespace flytri::rig
