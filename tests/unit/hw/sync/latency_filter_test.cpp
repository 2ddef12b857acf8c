#include "hw/sync/latency_filter.h"

#include <gtest/gtest.h>

#include "core/base/random.h"

namespace flytri::sync {
namespace {

constexpr double kFramePeriod_s = 1.0 / 30.0;
constexpr double kLatency_s = 0.045;

/// The estimate after 400 frames with an exposure window of `window_s` and random pattern
/// durations.
LatencyEstimate learn(const LatencyOptions& options, double window_s) {
  LatencyFilter filter(options);
  LightHistory history;
  Random random(1);
  double switched_s = 0.0;
  std::int64_t request = 0;
  for (int i = 0; i < 400; ++i) {
    const double middle_s = 1.0 + i * kFramePeriod_s;
    for (; switched_s < middle_s + kLatency_s;
         switched_s += (1.2 + random.uniform()) * kFramePeriod_s) {
      const device::Light light =
          ++request % 2 == 0 ? device::Light::kVertical : device::Light::kHorizontal;
      history.switched({request, light, switched_s, switched_s, true});
    }
    const LightTimes lit = history.times(middle_s - 0.5 * window_s, middle_s + 0.5 * window_s);
    LightEvidence evidence;
    evidence.has_lines = true;
    evidence.line_places = 5000;
    evidence.column_share = lit.lit(device::Light::kVertical) / window_s;
    filter.learn(history, middle_s + kLatency_s, evidence);
  }
  return filter.estimate();
}

TEST(LatencyFilter, LearnsLatencyAndWindow) {
  const LatencyEstimate estimate = learn({}, 0.02);
  EXPECT_NEAR(estimate.latency_s, kLatency_s, 0.001);
  EXPECT_NEAR(estimate.window_s, 0.02, 0.002);
  EXPECT_LT(estimate.swapped, 0.01);
}

// With a rolling shutter, the first and last rows may not see the object; the window then looks
// shorter than it is.
TEST(LatencyFilter, NeverEstimatesAWindowBelowTheMinimum) {
  LatencyOptions options;
  options.min_window_s = 0.03;
  const LatencyEstimate estimate = learn(options, 0.01);
  EXPECT_GE(estimate.window_s, 0.029);
  EXPECT_NEAR(estimate.latency_s, kLatency_s, 0.004);
}

TEST(LatencyFilter, LimitsTheWindowToTheLongestOfTheGrid) {
  LatencyOptions options;
  options.min_window_s = 1.0;
  EXPECT_NEAR(learn(options, 0.045).window_s, 1.5 * kFramePeriod_s, 1e-9);
}

}  // namespace
}  // namespace flytri::sync
