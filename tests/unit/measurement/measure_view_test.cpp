#include "core/measurement/measure_view.h"

#include <gtest/gtest.h>

#include "tests/support/analytic_calibration.h"

namespace flytri::measurement {
namespace {

using testing::analytic_calibration;
using testing::AnalyticSensor;
using testing::draw_lines;

Frame plane_frame(Pattern pattern, FrameKind kind, double z_mm) {
  return {FrameIndex(7), kind, 0.25, draw_lines(AnalyticSensor{}, pattern, z_mm, 99)};
}

TEST(MeasureView, MeasuresAPlaneAtItsTruePlace) {
  for (const Pattern pattern : kPatterns) {
    const FrameKind kind =
        pattern == Pattern::kVertical ? FrameKind::kVertical : FrameKind::kHorizontal;
    const auto measured = measure_view(plane_frame(pattern, kind, 1.7), analytic_calibration(), {});
    ASSERT_TRUE(measured.has_value());
    EXPECT_EQ(measured->outcome, MeasureOutcome::kMeasured);
    EXPECT_EQ(measured->view.pattern, pattern);
    EXPECT_EQ(measured->view.frame.value, 7);
    EXPECT_EQ(measured->view.time_s, 0.25);
    EXPECT_EQ(static_cast<int>(measured->view.profiles.size()),
              AnalyticSensor{}.line_counts[static_cast<std::size_t>(pattern)]);
    double square = 0, expected = 0;
    for (const Profile& profile : measured->view.profiles) {
      for (const ProfilePoint& point : profile.points) {
        square += std::pow(point.position_mm.z() - 1.7, 2);
        expected += std::pow(point.deviation_mm.z(), 2);
      }
    }
    EXPECT_NEAR(std::sqrt(square / expected), 1.0, 0.15);  // the stated noise is right
  }
}

TEST(MeasureView, CountsAddUp) {
  const auto measured = measure_view(plane_frame(Pattern::kVertical, FrameKind::kVertical, 5.1),
                                     analytic_calibration(), {});
  ASSERT_TRUE(measured.has_value());
  const MeasureCounts& counts = measured->counts;
  EXPECT_GT(counts.localized, 0);
  EXPECT_EQ(counts.localized, counts.index.total());
  EXPECT_EQ(counts.index.indexed, counts.points + counts.short_profiles);
}

TEST(MeasureView, RecognizesThePatternOfUnknownFrames) {
  for (const Pattern pattern : kPatterns) {
    const auto measured =
        measure_view(plane_frame(pattern, FrameKind::kUnknown, -2.0), analytic_calibration(), {});
    ASSERT_TRUE(measured.has_value());
    EXPECT_EQ(measured->outcome, MeasureOutcome::kMeasured);
    EXPECT_EQ(measured->view.pattern, pattern);
  }
}

TEST(MeasureView, AFrameWithBothPatternsIsAmbiguous) {
  // A rolling shutter during the switch: the upper half shows one pattern, the lower half the
  // other.
  Frame frame = plane_frame(Pattern::kVertical, FrameKind::kUnknown, 0.0);
  const cv::Mat other = draw_lines(AnalyticSensor{}, Pattern::kHorizontal, 0.0, 5);
  const int half = frame.image.rows / 2;
  other.rowRange(half, frame.image.rows).copyTo(frame.image.rowRange(half, frame.image.rows));
  const auto measured = measure_view(frame, analytic_calibration(), {});
  ASSERT_TRUE(measured.has_value());
  EXPECT_EQ(measured->outcome, MeasureOutcome::kAmbiguousPattern);
  EXPECT_TRUE(measured->view.profiles.empty());
}

TEST(MeasureView, ABlankFrameIsAnOutcome) {
  for (const FrameKind kind : {FrameKind::kVertical, FrameKind::kUnknown}) {
    const Frame dark{FrameIndex(0), kind, 0.0, cv::Mat(320, 420, CV_8UC1, cv::Scalar(5))};
    const auto measured = measure_view(dark, analytic_calibration(), {});
    ASSERT_TRUE(measured.has_value());
    EXPECT_EQ(measured->outcome, MeasureOutcome::kTooFewPoints);
  }
}

TEST(MeasureView, RejectsFramesThatAreNotMeasurementFrames) {
  Frame frame = plane_frame(Pattern::kVertical, FrameKind::kTexture, 0.0);
  EXPECT_EQ(measure_view(frame, analytic_calibration(), {}).error().code, ErrorCode::kBadOption);
  frame.kind = FrameKind::kVertical;
  frame.image = frame.image.rowRange(0, 300);
  EXPECT_EQ(measure_view(frame, analytic_calibration(), {}).error().code, ErrorCode::kInconsistent);
  frame.image = cv::Mat(320, 420, CV_8UC3, cv::Scalar(0));
  EXPECT_EQ(measure_view(frame, analytic_calibration(), {}).error().code, ErrorCode::kBadFormat);
}

}  // namespace
}  // namespace flytri::measurement
