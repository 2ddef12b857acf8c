#include <gtest/gtest.h>

#include "core/reconstruct/finish_scan.h"
#include "core/reconstruct/row_share.h"
#include "tests/support/moved_light.h"
#include "tests/support/rolled_views.h"
#include "tests/support/scan_scene.h"

namespace flytri::reconstruct {
namespace {

const calibration::Calibration& row_calibration() {
  static const calibration::Calibration kCalibration = testing::camera_calibration();
  return kCalibration;
}

const std::vector<AlignedView>& global_views() {
  static const std::vector<AlignedView> kViews =
      testing::scan_cusps(60, {.noise_mm = 0.02}, 31, 0.3).views;
  return kViews;
}

FinishedScan finish(std::vector<AlignedView> views, bool corrects) {
  ScannedViews scanned;
  scanned.views = std::move(views);
  scanned.calibration = &row_calibration();
  FinishOptions options;
  options.correct_rolling_shutter = corrects;
  StageClock clock([] { return 0.0; });
  auto finished = finish_scan(scanned, options, Workers(2), {}, clock);
  EXPECT_TRUE(finished) << finished.error().message;
  return finished ? *std::move(finished) : FinishedScan();
}

TEST(RowShare, IsHalfAReadoutAtTheEndsOfTheImage) {
  const trajectory::RowShare share = row_share_of(row_calibration());
  const auto& size = row_calibration().measurement_size;
  // 0.1 mm for a pixel, whose center has a whole number.
  const double half_mm = 0.05 * size.height_px;
  EXPECT_NEAR(share({3.0, -half_mm - 0.05, 0.0}), -0.5, 1e-9);
  EXPECT_NEAR(share({3.0, half_mm - 0.05, 0.0}), 0.5, 1e-9);
}

TEST(RollingShutter, ModelIsMadeOfCorrectedPoints) {
  const auto measured = testing::rolled(global_views(), 0.02);
  const FinishedScan finished = finish(measured, true);
  ASSERT_TRUE(finished.readout);
  EXPECT_NEAR(finished.readout->readout_s, 0.02, 5e-4);
  // A scan that goes on has the points as they were measured.
  ASSERT_EQ(finished.views.size(), measured.size());
  for (std::size_t i = 0; i < measured.size(); ++i)
    EXPECT_EQ(finished.views[i].view, measured[i].view);
  EXPECT_FALSE(finish(measured, false).readout);
}

TEST(RollingShutter, GlobalShutterGivesTheSameBits) {
  const FinishedScan checked = finish(global_views(), true),
                     unchecked = finish(global_views(), false);
  EXPECT_FALSE(checked.readout);
  ASSERT_EQ(checked.points.size(), unchecked.points.size());
  for (std::size_t i = 0; i < checked.points.size(); ++i)
    EXPECT_EQ(checked.points[i].position_mm, unchecked.points[i].position_mm);
}

}  // namespace
}  // namespace flytri::reconstruct
