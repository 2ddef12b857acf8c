#include "hw/design/design_change.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace flytri::design {
namespace {

using simulated::SensorLayout;
using ::testing::HasSubstr;

TEST(DesignChange, WithoutChangesTheLayoutStays) {
  const SensorLayout layout = simulated::face_layout();
  const auto same = changed(layout, {});
  ASSERT_TRUE(same);
  EXPECT_EQ(same->baseline_mm, layout.baseline_mm);
  EXPECT_EQ(same->focal_px, layout.focal_px);
  EXPECT_EQ(same->volume_mm, layout.volume_mm);
}

TEST(DesignChange, TheFieldTakesLinesAndDotsWithIt) {
  DesignChange change;
  change.field_mm = Vec2(40.0, 30.0);
  const auto wide = changed(simulated::intraoral_layout(), change);
  ASSERT_TRUE(wide);
  EXPECT_EQ(wide->volume_mm, Vec3(40.0, 30.0, 15.0));
  EXPECT_DOUBLE_EQ(wide->focal_px, 1800.0);
  EXPECT_DOUBLE_EQ(wide->line_width_mm, 0.17);
  EXPECT_DOUBLE_EQ(wide->dots.pitch_mm, 2.0);
}

TEST(DesignChange, FocalLengthsInMillimetersGoThereAndBack) {
  const SensorLayout layout = simulated::intraoral_layout();
  DesignChange change;
  change.pixel_um = 3.75;
  change.focal_mm = camera_focal_mm(layout, change.pixel_um);
  // 3600 pixels of 3.75 µm are 13.5 mm; 1 / f = 1 / 13.5 + 1 / 70.
  EXPECT_NEAR(*change.focal_mm, 11.317, 1e-3);
  const auto same = changed(layout, change);
  ASSERT_TRUE(same);
  EXPECT_NEAR(same->focal_px, layout.focal_px, 1e-9);
}

TEST(DesignChange, TheFocusFollowsTheDistance) {
  DesignChange change;
  change.distance_mm = 160.0;
  EXPECT_DOUBLE_EQ(changed(simulated::intraoral_layout(), change)->focus_mm, 140.0);
  change.focus_mm = 150.0;
  EXPECT_DOUBLE_EQ(changed(simulated::intraoral_layout(), change)->focus_mm, 150.0);
}

TEST(DesignChange, TheAngleOfThePaperIsSevenDegrees) {
  EXPECT_NEAR(triangulation_angle_rad(simulated::intraoral_layout()) * 180.0 / M_PI, 7.0, 1e-9);
}

struct BadChange {
  DesignChange change;
  const char* message;
};

TEST(DesignChange, NumbersOutOfRangeAreNamed) {
  DesignChange baseline, far, lines, focal, depth, pixel;
  baseline.baseline_mm = -1.0;
  far.baseline_mm = 100.0;
  lines.lines = {{10, 0}};
  focal.focal_mm = 75.0;
  depth.depth_mm = 150.0;
  pixel.pixel_um = 0.0;
  for (const BadChange& bad :
       {BadChange{baseline, "baseline_mm is -1"}, BadChange{far, "baseline_mm is 100"},
        BadChange{lines, "lines is 0"}, BadChange{focal, "focal_mm is 75"},
        BadChange{depth, "depth_mm is 150"}, BadChange{pixel, "pixel_um is 0"}}) {
    const auto refused = changed(simulated::intraoral_layout(), bad.change);
    ASSERT_FALSE(refused) << bad.message;
    EXPECT_THAT(refused.error().message, HasSubstr(bad.message));
  }
}

}  // namespace
}  // namespace flytri::design
