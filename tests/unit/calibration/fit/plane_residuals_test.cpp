#include "core/calibration/fit/plane_residuals.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/calibration/fit/calibrate.h"
#include "tests/support/analytic_sensor.h"

namespace flytri::calibration {
namespace {

using testing::AnalyticSensor;
using ::testing::HasSubstr;

constexpr std::size_t kSpoiled = 4;
constexpr double kOff_mm = 0.06;

/// Nine planes, one of them at another depth for some of the patterns.
CalibrationSet set_with_misplaced(std::initializer_list<Pattern> patterns) {
  const AnalyticSensor sensor;
  static const CalibrationSet kGood = draw_set(sensor, 9);
  CalibrationSet set = kGood;
  CalibrationPlane& plane = set.planes[kSpoiled];
  for (const Pattern pattern : patterns) {
    cv::Mat& image = pattern == Pattern::kVertical ? plane.vertical : plane.horizontal;
    image = draw_lines(sensor, pattern, plane.z_mm + kOff_mm, 77);
  }
  return set;
}

std::vector<PlaneResidual> residuals_of(const CalibrationSet& set) {
  const Calibration calibration = calibrate(set, {}, Workers(2), {}).value();
  return plane_residuals(set, calibration, {}, Workers(2)).value();
}

Result<void> check(const CalibrationSet& set) {
  return check_plane_residuals(residuals_of(set), set.volume, {});
}

TEST(PlaneResiduals, AreSmallForAGoodSet) {
  const CalibrationSet set = set_with_misplaced({});
  for (const PlaneResidual& plane : residuals_of(set)) {
    for (const std::size_t pattern : {0U, 1U}) {
      // The mean of thousands of samples with 8 µm of noise is well below 1 µm; so is the error of
      // the cubic.
      EXPECT_LT(std::abs(plane.offset_mm[pattern]), 1.5e-3) << plane.z_mm;
      EXPECT_GT(plane.count[pattern], 500);
    }
  }
  EXPECT_TRUE(check(set).has_value());
}

TEST(PlaneResiduals, NameThePlaneAtAWrongDepth) {
  const auto refused = check(set_with_misplaced({Pattern::kVertical, Pattern::kHorizontal}));
  ASSERT_FALSE(refused.has_value());
  EXPECT_THAT(refused.error().message, HasSubstr("z = 0.00 mm"));
  EXPECT_THAT(refused.error().message, HasSubstr("was not at that depth"));
}

TEST(PlaneResiduals, ReportAPlaneThatMovedBetweenItsShots) {
  const auto refused = check(set_with_misplaced({Pattern::kHorizontal}));
  ASSERT_FALSE(refused.has_value());
  EXPECT_THAT(refused.error().message, HasSubstr("z = 0.00 mm"));
  EXPECT_THAT(refused.error().message, HasSubstr("moved between its shots"));
}

TEST(PlaneResiduals, ShowAPartOfTheErrorOfAPlane) {
  const auto planes = residuals_of(set_with_misplaced({Pattern::kVertical}));
  // The cubic through nine planes follows a third of the error of the middle plane.
  EXPECT_GT(planes[kSpoiled].offset_mm[0], 0.5 * kOff_mm);
  EXPECT_LT(planes[kSpoiled].offset_mm[0], 0.9 * kOff_mm);
  EXPECT_LT(std::abs(planes[kSpoiled].offset_mm[1]), 1.5e-3);
}

}  // namespace
}  // namespace flytri::calibration
