#include "core/calibration/verify/pattern_shift.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "core/base/random.h"

namespace flytri::calibration {
namespace {

constexpr double kPeriod_s = 1.0 / 30.0;
const Vec3 kVolume_mm(20, 15, 15);

/// A hand that moves along an arch and trembles by 0.1 mm at 9 Hz.
Isometry hand_pose(double time_s) {
  Twist twist;
  twist << 0.2 * std::sin(0.3 * time_s), 0.1 * std::cos(0.5 * time_s),
      0.002 * std::sin(55.0 * time_s),
      20.0 * std::sin(0.2 * time_s) + 0.1 * std::sin(57.0 * time_s),
      10.0 * std::cos(0.3 * time_s) + 0.1 * std::sin(58.0 * time_s), 0.1 * std::sin(59.0 * time_s);
  return exp_twist(twist);
}

/// A scan in which the vertical lines are measured `shift_mm` too far, from a view on.
std::vector<AlignedView> scan(int count, int bumped_at, const Vec3& shift_mm) {
  Random random(3);
  std::vector<AlignedView> views;
  for (int i = 0; i < count; ++i) {
    auto view = std::make_shared<View>();
    view->pattern = i % 2 == 0 ? Pattern::kVertical : Pattern::kHorizontal;
    view->frame = FrameIndex(i);
    view->time_s = i * kPeriod_s;
    Isometry T_world_sensor = hand_pose(view->time_s);
    Vec3 error_mm(0.01 * random.normal(), 0.01 * random.normal(), 0.01 * random.normal());
    // The registration brings the points to where the others are.
    if (i >= bumped_at && view->pattern == Pattern::kVertical) error_mm -= shift_mm;
    T_world_sensor.translate(error_mm);
    views.push_back({view, T_world_sensor});
  }
  return views;
}

TEST(PatternShift, ATremblingHandIsNoShift) {
  const auto found = find_pattern_shift(scan(900, 0, Vec3::Zero()), kVolume_mm);
  ASSERT_TRUE(found);
  EXPECT_LT(found->shift_mm.norm(), 4.0 * found->uncertainty_mm);
  EXPECT_LT(found->uncertainty_mm, 0.02);
  EXPECT_FALSE(found->is_large());
}

TEST(PatternShift, TellsHowFarAndWhereTo) {
  const Vec3 shift_mm(0.01, 0.0, 0.15);
  const auto found = find_pattern_shift(scan(900, 0, shift_mm), kVolume_mm);
  ASSERT_TRUE(found);
  EXPECT_LT((found->shift_mm - shift_mm).norm(), 4.0 * found->uncertainty_mm);
  EXPECT_TRUE(found->is_large());
}

TEST(PatternShift, HarmsAFaceOnlyIfItIsLarger) {
  const Vec3 face_mm(200, 150, 100);
  const auto found = find_pattern_shift(scan(900, 0, Vec3(0.0, 0.0, 0.15)), face_mm);
  ASSERT_TRUE(found);
  EXPECT_FALSE(found->is_large());
  EXPECT_TRUE(find_pattern_shift(scan(900, 0, Vec3(0.0, 0.0, 1.5)), face_mm)->is_large());
}

TEST(PatternShift, ABumpDuringTheScanIsNoticedSoon) {
  constexpr int kBumpedAt = 900;
  PatternShiftGauge gauge(kVolume_mm);
  int noticed_at = 0;
  for (const AlignedView& view : scan(1800, kBumpedAt, Vec3(0.0, 0.0, 0.15))) {
    gauge.add(view);
    const auto shift = gauge.shift();
    if (noticed_at == 0 && shift && shift->is_large()) noticed_at = view.view->frame.value;
  }
  EXPECT_GT(noticed_at, kBumpedAt);
  EXPECT_LT((noticed_at - kBumpedAt) * kPeriod_s, 10.0);
}

TEST(PatternShift, FewViewsAndViewsFarApartTellNothing) {
  EXPECT_FALSE(find_pattern_shift(scan(90, 0, Vec3(0.0, 0.0, 0.15)), kVolume_mm));
  std::vector<AlignedView> gaps;
  for (const AlignedView& view : scan(900, 0, Vec3(0.0, 0.0, 0.15))) {
    // Every third is lost: two of a pattern never stand around one of the other.
    if (view.view->frame.value % 3 != 2) gaps.push_back(view);
  }
  const auto found = find_pattern_shift(gaps, kVolume_mm);
  EXPECT_TRUE(!found || found->views < 300U);
}

TEST(ShiftedSpans, ABumpDuringTheScanDividesIt) {
  const Vec3 shift_mm(0.01, 0.0, 0.15);
  const auto spans = find_shifted_spans(scan(1800, 900, shift_mm), kVolume_mm);
  ASSERT_EQ(spans.size(), 1U);
  EXPECT_NEAR(spans[0].from_s, 900 * kPeriod_s, 8 * kPeriod_s);
  EXPECT_GT(spans[0].to_s, 1800 * kPeriod_s);
  EXPECT_LT((spans[0].shift.shift_mm - shift_mm).norm(), 4.0 * spans[0].shift.uncertainty_mm);
}

TEST(ShiftedSpans, ScansWithoutAShiftHaveNone) {
  EXPECT_TRUE(find_shifted_spans(scan(1800, 0, Vec3::Zero()), kVolume_mm).empty());
  EXPECT_TRUE(find_shifted_spans(scan(90, 0, Vec3(0.0, 0.0, 0.15)), kVolume_mm).empty());
  EXPECT_TRUE(find_shifted_spans({}, kVolume_mm).empty());
}

TEST(ShiftedSpans, AShiftOfTheWholeScanIsOneSpan) {
  const auto spans = find_shifted_spans(scan(900, 0, Vec3(0.0, 0.0, -0.15)), kVolume_mm);
  ASSERT_EQ(spans.size(), 1U);
  EXPECT_LT(spans[0].from_s, 0.0);
  EXPECT_GT(spans[0].to_s, 900 * kPeriod_s);
}

}  // namespace
}  // namespace flytri::calibration
