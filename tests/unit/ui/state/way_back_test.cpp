#include "ui/state/way_back.h"

#include <gtest/gtest.h>

namespace flytri::ui {
namespace {

TEST(WayBack, LeadsFromTheProbablePoseToTheChosenPlace) {
  scan::ScanSnapshot scan;
  EXPECT_FALSE(way_back(scan));
  scan.lost_sensor.T_world_sensor =
      Isometry(Eigen::Translation3d(3.0, 4.0, 0.0)) * Eigen::AngleAxisd(0.35, Vec3::UnitX());
  EXPECT_FALSE(way_back(scan)) << "there is no place to resume at";
  scan.reentry.resize(1);
  const auto way = way_back(scan);
  ASSERT_TRUE(way);
  EXPECT_NEAR(way->distance_mm(), 5.0, 1e-9);
  EXPECT_NEAR(way->tilt_rad, 0.35, 1e-9);
  EXPECT_EQ(words_of(*way, Texts()), "Move 5 mm along the arrow, tilt by 20°");
}

TEST(WayBack, SaysThatTheSurfaceIsTooSmooth) {
  scan::ScanSnapshot scan;
  scan.reentry.resize(1);
  scan.lost_sensor = {Isometry(Eigen::Translation3d(12.0, 0.0, 0.0)), true};
  EXPECT_EQ(words_of(*way_back(scan), Texts()), "Too smooth here: move 12 mm along the arrow");
}

}  // namespace
}  // namespace flytri::ui
