#include "hw/rig/linearity.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "core/base/random.h"

namespace flytri::rig {
namespace {

using ::testing::HasSubstr;

/// Eight exposures over a factor of eight, with little noise.
std::vector<ExposureStep> steps_of(double gamma, double black, double white) {
  Random random(1);
  std::vector<ExposureStep> steps;
  for (int i = 1; i <= 8; ++i) {
    const double gray = black + (white - black) * std::pow(i / 8.0, gamma);
    steps.push_back({i * 0.001, std::min(1.0, gray) + 0.002 * (random.uniform() - 0.5)});
  }
  return steps;
}

TEST(Linearity, AcceptsALinearCameraWithAnyBlackLevel) {
  for (const double black : {-0.07, 0.0, 0.06}) {
    const auto linearity = judge_linearity(steps_of(1.0, black, 0.9));
    ASSERT_TRUE(linearity) << linearity.error().message;
    EXPECT_TRUE(linearity->is_linear);
    EXPECT_NEAR(linearity->black, black, 0.005);
    EXPECT_NEAR(linearity->gamma, 1.0, 0.02);
  }
}

TEST(Linearity, NamesTheGammaOfACameraThatIsNotLinear) {
  for (const double gamma : {0.45, 0.8, 1.25, 2.2}) {
    const auto linearity = judge_linearity(steps_of(gamma, 0.0, 0.9));
    ASSERT_TRUE(linearity) << linearity.error().message;
    EXPECT_FALSE(linearity->is_linear) << gamma;
    EXPECT_NEAR(linearity->gamma, gamma, 0.15 * gamma);
  }
}

TEST(Linearity, LeavesOutOverexposedSteps) {
  const auto linearity = judge_linearity(steps_of(1.0, 0.0, 1.5));
  ASSERT_TRUE(linearity);
  EXPECT_TRUE(linearity->is_linear);
}

TEST(Linearity, SaysWhatToChangeIfItCannotBeJudged) {
  EXPECT_THAT(judge_linearity(steps_of(1.0, 0.0, 4.0)).error().message, HasSubstr("shorter"));
  EXPECT_THAT(judge_linearity(steps_of(1.0, 0.3, 0.35)).error().message, HasSubstr("more light"));
}

}  // namespace
}  // namespace flytri::rig
