#include "core/reconstruct/correct_projectors.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/reconstruct/finish_scan.h"
#include "tests/support/moved_light.h"
#include "tests/support/scan_scene.h"

namespace flytri::reconstruct {
namespace {

using testing::bump;
using testing::displacement_rms_mm;
using testing::misled;

/// A scan of 7 s.
const std::vector<AlignedView>& truth() {
  static const std::vector<AlignedView> kViews =
      testing::with_tilted_sheets(testing::scan_cusps(200, {.noise_mm = 0.02}, 21, 0.15).views);
  return kViews;
}

struct Corrected {
  std::vector<AlignedView> before;
  std::optional<CorrectedScan> scan;
};

Corrected correct(const std::vector<AlignedView>& measured) {
  Corrected corrected{measured, std::nullopt};
  const auto fit = refinement::refine_jointly(corrected.before, {}, Workers(2), {});
  EXPECT_TRUE(fit);
  auto scan =
      correct_projectors(corrected.before, *fit,
                         calibration::find_shifted_spans(
                             corrected.before, testing::camera_calibration().volume.size_mm),
                         testing::camera_calibration(), {}, Workers(2), {});
  EXPECT_TRUE(scan) << scan.error().message;
  corrected.scan = *std::move(scan);
  return corrected;
}

class CorrectProjectors : public ::testing::TestWithParam<Pattern> {};

TEST_P(CorrectProjectors, FindWhichOneMovedAndPutItsPointsInPlace) {
  const Corrected corrected = correct(misled(truth(), bump(GetParam(), 3.0)));
  ASSERT_TRUE(corrected.scan);
  for (const refinement::ProjectorMotion& moved : corrected.scan->moved)
    EXPECT_EQ(moved.pattern, GetParam());
  EXPECT_NEAR(corrected.scan->moved.front().from_s, 3.0, 0.2);
  // The views where the projector may have been moving have no points.
  std::vector<AlignedView> after, before, true_views;
  for (std::size_t i = 0; i < truth().size(); ++i) {
    const AlignedView& view = corrected.scan->views[i];
    if (view.view->profiles.empty()) {
      EXPECT_EQ(view.view->pattern, GetParam());
      continue;
    }
    after.push_back(view);
    before.push_back(corrected.before[i]);
    true_views.push_back(truth()[i]);
  }
  EXPECT_GT(after.size(), truth().size() - 20);
  EXPECT_LT(displacement_rms_mm(after, true_views), 0.4 * displacement_rms_mm(before, true_views));
}

INSTANTIATE_TEST_SUITE_P(Patterns, CorrectProjectors, ::testing::ValuesIn(kPatterns),
                         [](const auto& test) { return std::string(to_string(test.param)); });

TEST(CorrectedScan, IsWhatTheModelIsMadeOf) {
  const calibration::Calibration calibration = testing::camera_calibration();
  ScannedViews scanned;
  scanned.views = misled(truth(), bump(Pattern::kHorizontal, 3.0));
  const auto measured = scanned.views;
  scanned.calibration = &calibration;
  StageClock clock([] { return 0.0; });
  const auto finished = finish_scan(scanned, {}, Workers(2), {}, clock);
  ASSERT_TRUE(finished) << finished.error().message;
  ASSERT_FALSE(finished->moved_projectors.empty());
  ASSERT_EQ(finished->T_world_sensor.size(), finished->views.size());
  EXPECT_EQ(finished->views.size(), measured.size());
  // A scan that goes on has the points as they were measured, with the poses that fit them.
  double farthest_mm = 0.0;
  for (std::size_t i = 0; i < finished->views.size(); ++i) {
    const AlignedView& view = finished->views[i];
    EXPECT_EQ(view.view, measured[static_cast<std::size_t>(view.view->frame.value)].view);
    const Isometry T_seen_true = view.T_world_sensor.inverse() * finished->T_world_sensor[i];
    farthest_mm = std::max(farthest_mm, T_seen_true.translation().norm());
  }
  EXPECT_GT(farthest_mm, 0.08);

  FinishOptions as_measured;
  as_measured.correct_projectors = false;
  scanned.views = measured;
  const auto uncorrected = finish_scan(scanned, as_measured, Workers(2), {}, clock);
  ASSERT_TRUE(uncorrected) << uncorrected.error().message;
  EXPECT_TRUE(uncorrected->moved_projectors.empty());
}

TEST(CorrectedScan, GoodScansStayAsTheyAre) { EXPECT_FALSE(correct(truth()).scan); }

TEST(CorrectedScan, ParallelRaysOfACameraCorrectNothing) {
  auto views = misled(truth(), bump(Pattern::kVertical, 3.0));
  const auto fit = refinement::refine_jointly(views, {}, Workers(2), {});
  ASSERT_TRUE(fit);
  const auto scan = correct_projectors(
      views, *fit,
      calibration::find_shifted_spans(views, testing::camera_calibration().volume.size_mm), {}, {},
      Workers(2), {});
  ASSERT_TRUE(scan);
  EXPECT_FALSE(*scan);
}

}  // namespace
}  // namespace flytri::reconstruct
