#include "core/indexing/index_lines.h"

#include <gtest/gtest.h>

#include "tests/support/analytic_calibration.h"

namespace flytri::indexing {
namespace {

using testing::analytic_calibration;
using testing::AnalyticSensor;

/// The trace of line n on a surface z(along), without localization errors.
template <typename Depth>
localization::LineTrace trace_of(Pattern pattern, int n, Depth depth) {
  const AnalyticSensor sensor;
  localization::LineTrace trace;
  for (int along = 40; along < 280; ++along) {
    const double z = depth(along);
    trace.push_back({along, static_cast<float>(sensor.across_px(pattern, n, along, z)),
                     static_cast<float>(2.3548 * sensor.line_sigma_px(z)), 100.0F, 0.05F, false});
  }
  return trace;
}

TEST(IndexLines, EveryLineInsideTheVolumeKeepsItsNumber) {
  const AnalyticSensor sensor;
  for (const Pattern pattern : kPatterns) {
    for (int n = 0; n < sensor.line_counts[static_cast<std::size_t>(pattern)]; ++n) {
      const auto trace =
          trace_of(pattern, n, [](int along) { return 4.9 * std::sin(0.03 * along); });
      const auto indexed = index_lines({trace}, analytic_calibration(), pattern, {});
      ASSERT_EQ(indexed.traces.size(), 1U);
      EXPECT_EQ(indexed.traces[0].line.value, n);
      EXPECT_EQ(indexed.counts.indexed, static_cast<int>(trace.size()));
      EXPECT_EQ(indexed.counts.total(), static_cast<int>(trace.size()));
    }
  }
}

TEST(IndexLines, CutsATraceThatLeavesTheVolume) {
  const auto trace =
      trace_of(Pattern::kVertical, 2, [](int along) { return 3.0 + 0.0125 * (along - 40); });
  IndexOptions options;
  options.area_margin = 0.0;
  const auto indexed = index_lines({trace}, analytic_calibration(), Pattern::kVertical, options);
  ASSERT_GE(indexed.traces.size(), 1U);
  const localization::LineTrace& kept = indexed.traces[0].samples;
  EXPECT_NEAR(kept.back().along_px, 200, 3);  // z is 5 there, the end of the volume
  EXPECT_GT(indexed.counts.outside_areas, 20);
}

TEST(IndexLines, RejectsALineBehindTheVolumeByItsWidth) {
  // Far behind the volume, line 2 runs through the area of a neighbor.
  const AnalyticSensor sensor;
  double z = 5.0;
  const auto& rows = analytic_calibration().of(Pattern::kVertical).lines;
  const auto labeled_at = [&](double depth) {
    const double across = sensor.across_px(Pattern::kVertical, 2, 160, depth);
    for (std::size_t n = 0; n < rows.size(); ++n) {
      if (across >= rows[n][160].area_min_px && across <= rows[n][160].area_max_px) return int(n);
    }
    return -1;
  };
  while (labeled_at(z) == 2 || labeled_at(z) == -1) z += 0.25;
  localization::LineTrace trace = trace_of(Pattern::kVertical, 2, [z](int) { return z + 1.0; });
  for (localization::LineSample& sample : trace)
    sample.width_px *= 1.5F;  // defocus grows faster outside the volume
  const auto indexed = index_lines({trace}, analytic_calibration(), Pattern::kVertical, {});
  EXPECT_TRUE(indexed.traces.empty());
  EXPECT_GT(indexed.counts.wrong_width, 0);
  EXPECT_EQ(indexed.counts.indexed, 0);
}

TEST(IndexLines, CutsALineThatContinuesAsADistantLineAfterADepthStep) {
  // After the depth step, a distant line continues where this one ended.
  localization::LineTrace trace = trace_of(Pattern::kVertical, 2, [](int) { return 1.0; });
  constexpr int kStep_px = 190;
  for (localization::LineSample& sample : trace) {
    if (sample.along_px >= kStep_px) sample.width_px *= 2.2F;
  }
  const auto indexed = index_lines({trace}, analytic_calibration(), Pattern::kVertical, {});
  ASSERT_EQ(indexed.traces.size(), 1U);
  const localization::LineTrace& kept = indexed.traces[0].samples;
  const float width_px = kept.front().width_px;
  EXPECT_LT(kept.back().along_px, kStep_px);
  EXPECT_GT(kept.back().along_px, kStep_px - 3.0F * width_px);
  EXPECT_EQ(indexed.counts.total(), static_cast<int>(trace.size()));
  EXPECT_EQ(indexed.counts.indexed, static_cast<int>(kept.size()));
}

TEST(IndexLines, SingleWrongWidthsAreIgnored) {
  localization::LineTrace trace = trace_of(Pattern::kVertical, 2, [](int) { return 1.0; });
  for (std::size_t i = 0; i < trace.size(); i += 7) trace[i].width_px *= 2.0F;
  const auto indexed = index_lines({trace}, analytic_calibration(), Pattern::kVertical, {});
  EXPECT_EQ(indexed.counts.indexed, static_cast<int>(trace.size()));
}

TEST(IndexLines, CountsShortSegments) {
  localization::LineTrace trace = trace_of(Pattern::kVertical, 1, [](int) { return 0.0; });
  trace.resize(3);
  const auto indexed = index_lines({trace}, analytic_calibration(), Pattern::kVertical, {});
  EXPECT_EQ(indexed.counts.short_segments, 3);
}

TEST(IndexLines, RejectsBadOptions) {
  EXPECT_TRUE(IndexOptions{}.validate().has_value());
  EXPECT_FALSE((IndexOptions{.area_margin = 0.5}.validate().has_value()));
  EXPECT_FALSE((IndexOptions{.max_width_ratio = 0.9}.validate().has_value()));
  EXPECT_FALSE((IndexOptions{.max_local_width_ratio = 1.1}.validate().has_value()));
  EXPECT_FALSE((IndexOptions{.min_segment_length = 1}.validate().has_value()));
}

}  // namespace
}  // namespace flytri::indexing
