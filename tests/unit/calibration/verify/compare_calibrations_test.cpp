#include "core/calibration/verify/compare_calibrations.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/analytic_calibration.h"

namespace flytri::calibration {
namespace {

using testing::analytic_calibration;
using ::testing::HasSubstr;

/// The calibration of a stage that tilts, with a target and a step of wrong size.
Calibration of_wrong_stage(const MetricCorrection& truth) {
  // The inverse of a correction is one, too.
  return corrected(analytic_calibration(), {1.0 / truth.lateral, 1.0 / truth.depth,
                                            -truth.shear / (truth.lateral * truth.depth)});
}

TEST(CompareCalibrations, FindsTheTiltOfTheStageAndBothScales) {
  for (const double tilt_deg : {0.0, 0.2, 1.0, 2.0}) {
    SCOPED_TRACE(tilt_deg);
    const double shear = std::tan(tilt_deg * std::numbers::pi / 180.0);
    const MetricCorrection truth{1.002, 0.997, {shear, -0.5 * shear}};
    const auto found = compare_calibrations(of_wrong_stage(truth), analytic_calibration());
    ASSERT_TRUE(found) << found.error().message;
    EXPECT_NEAR(found->correction.lateral, truth.lateral, 1e-6);
    EXPECT_NEAR(found->correction.depth, truth.depth, 1e-6);
    EXPECT_LT((found->correction.shear - truth.shear).norm(), 1e-6);
    EXPECT_LT(found->left_mm, 1e-5);
  }
}

TEST(CompareCalibrations, ACalibrationHoldsAgainstItself) {
  const auto same = compare_calibrations(analytic_calibration(), analytic_calibration());
  ASSERT_TRUE(same) << same.error().message;
  const VerificationReport report = judge_comparison(*same, analytic_calibration());
  EXPECT_EQ(report.outcome, VerificationOutcome::kValid);
  EXPECT_EQ(report.figures.size(), 4U);
}

TEST(CompareCalibrations, NamesTheStageAndTheScale) {
  const Calibration wrong = of_wrong_stage({1.01, 1.0, {0.02, 0.0}});
  const auto found = compare_calibrations(wrong, analytic_calibration());
  ASSERT_TRUE(found) << found.error().message;
  const VerificationReport report = judge_comparison(*found, wrong);
  EXPECT_EQ(report.outcome, VerificationOutcome::kBroken);
  EXPECT_THAT(report.meanings, ::testing::ElementsAre(HasSubstr("stage did not move"),
                                                      HasSubstr("too long or too short")));
}

TEST(CompareCalibrations, RefusesAnotherSensor) {
  Calibration other = analytic_calibration();
  other.patterns[0].lines.pop_back();
  auto result = compare_calibrations(analytic_calibration(), other);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kInconsistent);
  EXPECT_THAT(result.error().message, HasSubstr("different sensors"));

  // As many lines, but the surface is seen bent.
  other = analytic_calibration();
  for (auto& line : other.patterns[0].lines) {
    for (LineRow& row : line) row.depth_mm.coefficients[2] += 0.5;
  }
  result = compare_calibrations(analytic_calibration(), other);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kInconsistent);
  EXPECT_THAT(result.error().message, HasSubstr("µm apart"));
}

TEST(CompareCalibrations, RefusesVolumesThatDoNotOverlap) {
  Calibration empty = analytic_calibration();
  for (PatternCalibration& pattern : empty.patterns) {
    for (auto& line : pattern.lines)
      for (LineRow& row : line) row.area_max_px = row.area_min_px - 1.0;
  }
  const auto result = compare_calibrations(analytic_calibration(), empty);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kInsufficient);
}

}  // namespace
}  // namespace flytri::calibration
