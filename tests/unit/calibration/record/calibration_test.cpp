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

TEST(ProjectToMeasurement, FindsThePixelOfALocatedPoint) {
  const Calibration calibration = testing::analytic_calibration();
  int count = 0;
  for (const Pattern pattern : kPatterns) {
    const auto& lines = calibration.of(pattern).lines;
    for (std::size_t n = 0; n < lines.size(); ++n) {
      for (std::size_t along = 0; along < lines[n].size(); along += 37) {
        const LineRow& row = lines[n][along];
        if (!row.valid()) continue;
        for (const double across_px : {row.area_min_px, row.area_max_px}) {
          const LinePixel line_pixel{double(along), across_px};
          const Pixel seen = to_pixel(pattern, line_pixel);
          const Pixel found = calibration.project_to_measurement(
              calibration.locate(pattern, LineIndex(static_cast<int>(n)), line_pixel));
          EXPECT_NEAR(found.u_px, seen.u_px, 1e-6);
          EXPECT_NEAR(found.v_px, seen.v_px, 1e-6);
          ++count;
        }
      }
    }
  }
  EXPECT_GT(count, 50);
}

TEST(CameraCenter, ParallelRaysHaveNone) { EXPECT_FALSE(Calibration().camera_center_mm()); }

}  // namespace
}  // namespace flytri::calibration
