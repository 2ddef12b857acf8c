#include <gtest/gtest.h>

#include <cmath>

#include "core/calibration/fit/calibrate.h"
#include "core/calibration/fit/plane_residuals.h"
#include "core/indexing/depth_steps.h"
#include "core/measurement/measure_view.h"
#include "tests/support/analytic_sensor.h"

namespace flytri::indexing {
namespace {

using testing::AnalyticSensor;

/// A sensor with so many lines that each place of the image can be of three or four.
AnalyticSensor dense_sensor() {
  AnalyticSensor sensor;
  sensor.projector_mm = 14.0;
  sensor.line_counts = {16, 12};
  sensor.line_spacing_mm = 1.0;
  return sensor;
}

const calibration::Calibration& dense_calibration() {
  static const auto calibration =
      calibration::calibrate(testing::draw_set(dense_sensor(), 9), {}, Workers(2), {});
  return calibration.value();
}

TEST(DenseLines, AreCalibratedThoughTheirAreasOverlap) {
  const auto set = testing::draw_set(dense_sensor(), 9);
  const auto calibration = calibration::calibrate(set, {}, Workers(2), {});
  ASSERT_TRUE(calibration.has_value()) << calibration.error().message;
  for (const Pattern pattern : kPatterns) {
    EXPECT_TRUE(calibration->of(pattern).has_shared_areas());
    EXPECT_EQ(calibration->of(pattern).line_count(),
              dense_sensor().line_counts[static_cast<std::size_t>(pattern)]);
    EXPECT_LT(calibration->of(pattern).depth_residual_mm.rms, 0.02);
  }
  const auto planes = calibration::plane_residuals(set, *calibration, {}, Workers(2));
  ASSERT_TRUE(planes.has_value()) << planes.error().message;
  EXPECT_TRUE(calibration::check_plane_residuals(*planes, set.volume, {}).has_value());
}

TEST(DenseLines, UsualSensorsShareNoAreas) {
  const auto calibration =
      calibration::calibrate(testing::draw_set(AnalyticSensor(), 9), {}, Workers(2), {});
  ASSERT_TRUE(calibration.has_value()) << calibration.error().message;
  for (const Pattern pattern : kPatterns) EXPECT_FALSE(calibration->of(pattern).has_shared_areas());
}

TEST(DenseLines, PlanesInAllDepthsGetTheRightNumbers) {
  int right = 0, wrong = 0, localized = 0;
  for (double z = -4.7; z <= 4.7; z += 0.47) {
    for (const Pattern pattern : kPatterns) {
      const FrameKind kind =
          pattern == Pattern::kVertical ? FrameKind::kVertical : FrameKind::kHorizontal;
      const Frame frame{FrameIndex(0), kind, 0.0,
                        testing::draw_lines(dense_sensor(), pattern, z, 3)};
      const auto measured = measurement::measure_view(frame, dense_calibration(), {});
      ASSERT_TRUE(measured.has_value()) << measured.error().message;
      localized += measured->counts.localized;
      EXPECT_EQ(measured->counts.localized, measured->counts.index.total());
      for (const Profile& profile : measured->view.profiles)
        for (const ProfilePoint& point : profile.points)
          ++(std::abs(point.position_mm.z() - z) < 0.3 ? right : wrong);
    }
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(right, localized * 98 / 100);
}

localization::LineTrace straight(int from, int to, float across_px, float width_px) {
  localization::LineTrace trace;
  for (int along = from; along < to; ++along)
    trace.push_back({along, across_px, width_px, 100.0F, 0.05F, false});
  return trace;
}

TEST(DepthSteps, ATraceIsCutWhereItsWidthJumps) {
  localization::LineTrace trace = straight(0, 100, 50.0F, 5.0F);
  const localization::LineTrace far = straight(100, 200, 50.0F, 6.5F);
  trace.insert(trace.end(), far.begin(), far.end());
  const auto parts = cut_at_depth_steps({trace});
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_NEAR(parts[1].samples.front().along_px, 100, 4);
  EXPECT_FALSE(parts[0].continues);
  EXPECT_TRUE(parts[1].continues);
}

TEST(DepthSteps, ATraceIsCutWhereItsPlaceJumps) {
  localization::LineTrace trace = straight(0, 100, 50.0F, 5.0F);
  const localization::LineTrace far = straight(100, 200, 52.0F, 5.0F);
  trace.insert(trace.end(), far.begin(), far.end());
  const auto parts = cut_at_depth_steps({trace});
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_NEAR(parts[1].samples.front().along_px, 100, 4);
}

TEST(DepthSteps, ASmoothTraceStaysWhole) {
  localization::LineTrace trace;
  for (int along = 0; along < 300; ++along) {
    const auto across = static_cast<float>(60.0 + 20.0 * std::sin(0.02 * along));
    const auto width = static_cast<float>(6.0 + 1.0 * std::sin(0.02 * along));
    trace.push_back({along, across, width, 100.0F, 0.05F, false});
  }
  EXPECT_EQ(cut_at_depth_steps({trace}).size(), 1U);
}

}  // namespace
}  // namespace flytri::indexing
