#include "core/triangulation/triangulate.h"

#include <gtest/gtest.h>

#include "tests/support/analytic_calibration.h"

namespace flytri::triangulation {
namespace {

using testing::analytic_calibration;
using testing::AnalyticSensor;

indexing::IndexedLines one_trace(localization::LineTrace samples) {
  indexing::IndexedLines lines;
  lines.traces.push_back({LineIndex(3), std::move(samples)});
  return lines;
}

localization::LineTrace straight_trace(int first, int last, double z_mm) {
  const AnalyticSensor sensor;
  localization::LineTrace trace;
  for (int along = first; along < last; ++along) {
    const double across = sensor.across_px(Pattern::kVertical, 3, along, z_mm);
    trace.push_back({along, static_cast<float>(across), 4.0F, 100.0F, 0.06F, false});
  }
  return trace;
}

TEST(Triangulate, PointsAreOnTheSurface) {
  const AnalyticSensor sensor;
  const auto result = triangulate(one_trace(straight_trace(40, 280, 2.0)), analytic_calibration(),
                                  Pattern::kVertical, {});
  ASSERT_EQ(result.view.profiles.size(), 1U);
  const Profile& profile = result.view.profiles[0];
  EXPECT_EQ(profile.line.value, 3);
  ASSERT_EQ(profile.points.size(), 240U);
  for (const ProfilePoint& point : profile.points) {
    EXPECT_NEAR(point.position_mm.z(), 2.0, 1.5e-3);
    EXPECT_NEAR(point.position_mm.x(), sensor.line_mm(Pattern::kVertical, 3, 2.0), 3e-3);
  }
}

TEST(Triangulate, DeviationIsTheDisplacementByOneSigma) {
  const localization::LineTrace trace = straight_trace(40, 280, 2.0);
  localization::LineTrace moved = trace;
  for (localization::LineSample& sample : moved) sample.across_px += sample.sigma_px;
  const auto at = triangulate(one_trace(trace), analytic_calibration(), Pattern::kVertical, {});
  const auto by = triangulate(one_trace(moved), analytic_calibration(), Pattern::kVertical, {});
  for (std::size_t i = 0; i < trace.size(); ++i) {
    const ProfilePoint& point = at.view.profiles[0].points[i];
    const Vec3 step = by.view.profiles[0].points[i].position_mm - point.position_mm;
    // The lateral derivative is computed every 16 rows; for this near camera it changes by 1 % over
    // this distance.
    EXPECT_LT((step - point.deviation_mm.cast<double>()).norm(), 0.02 * step.norm());
  }
}

TEST(Triangulate, CutsProfilesAtGapsAndJumps) {
  localization::LineTrace trace = straight_trace(40, 100, 2.0);
  const localization::LineTrace after_gap = straight_trace(104, 150, 2.0),
                                after_jump = straight_trace(150, 200, 0.0);
  trace.insert(trace.end(), after_gap.begin(), after_gap.end());
  trace.insert(trace.end(), after_jump.begin(), after_jump.end());
  const auto result = triangulate(one_trace(trace), analytic_calibration(), Pattern::kVertical, {});
  ASSERT_EQ(result.view.profiles.size(), 3U);
  EXPECT_EQ(result.view.profiles[1].points.front().along_px, 104.0F);
  EXPECT_EQ(result.view.profiles[2].points.front().along_px, 150.0F);
}

TEST(Triangulate, CountsShortProfiles) {
  localization::LineTrace trace = straight_trace(40, 42, 2.0);
  const auto result = triangulate(one_trace(trace), analytic_calibration(), Pattern::kVertical, {});
  EXPECT_TRUE(result.view.profiles.empty());
  EXPECT_EQ(result.short_profiles, 2);
}

}  // namespace
}  // namespace flytri::triangulation
