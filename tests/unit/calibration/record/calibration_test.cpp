#include "core/calibration/record/calibration.h"

#include <gtest/gtest.h>

#include "tests/support/analytic_calibration.h"
#include "tests/support/moved_light.h"

namespace flytri::calibration {
namespace {

TEST(CameraCenter, IsWhereTheRaysMeet) {
  const auto center_mm = testing::camera_calibration().camera_center_mm();
  ASSERT_TRUE(center_mm);
  EXPECT_LT((*center_mm - testing::kCameraCenter_mm).norm(), 1e-6);
}

TEST(CameraCenter, OfAFittedCalibrationIsNearThatOfTheLens) {
  const auto center_mm = testing::analytic_calibration().camera_center_mm();
  ASSERT_TRUE(center_mm);
  EXPECT_LT((*center_mm - Vec3(0.0, 0.0, -testing::AnalyticSensor{}.distance_mm)).norm(), 1.5);
}

TEST(CameraCenter, ParallelRaysHaveNone) { EXPECT_FALSE(Calibration().camera_center_mm()); }

}  // namespace
}  // namespace flytri::calibration
