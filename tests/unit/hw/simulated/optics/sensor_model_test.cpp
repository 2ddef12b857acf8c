#include "hw/simulated/optics/sensor_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hw/simulated/optics/line_position.h"

namespace flytri::simulated {
namespace {

class SensorModels : public ::testing::TestWithParam<SensorModel (*)()> {
 protected:
  const SensorModel sensor = GetParam()();
};

TEST_P(SensorModels, PixelDirectionIsTheInverseOfProjection) {
  for (const CameraModel& camera : {sensor.camera, sensor.texture_camera})
    for (const double x : {-0.4, 0.0, 0.4})
      for (const double z : {-0.5, 0.5}) {
        const Vec3 p = sensor.volume.size_mm.cwiseProduct(Vec3(x, 0.7 * x, z));
        const Pixel pixel = camera.project(p).value();
        const Vec3 to_point = (p - camera.center()).normalized();
        EXPECT_LT((camera.direction(pixel) - to_point).norm(), 1e-10);
      }
}

TEST_P(SensorModels, SlidePlaceIsTheInverseOfProjectorDirection) {
  for (const Pattern pattern : kPatterns) {
    const ProjectorModel& projector = sensor.projector(pattern);
    const Vec3 p =
        projector.center() + 1.1 * projector.direction(0.03, -0.05) * projector.center().norm();
    EXPECT_LT((projector.slide_place(p).value() - Vec2(0.03, -0.05)).norm(), 1e-12);
  }
}

TEST_P(SensorModels, BothCamerasSeeTheWholeVolume) {
  for (const double x : {-0.5, 0.5})
    for (const double y : {-0.5, 0.5})
      for (const double z : {-0.5, 0.0, 0.5}) {
        const Vec3 p = sensor.volume.size_mm.cwiseProduct(Vec3(x, y, z));
        // By mounting errors, the measurement camera may miss one or two pixel rows at the near
        // corners.
        const Vec3 inner = p.cwiseProduct(Vec3(0.97, 0.97, 1.0));
        EXPECT_TRUE(sensor.camera.sees(sensor.camera.project(inner).value())) << p.transpose();
        EXPECT_TRUE(sensor.texture_camera.sees(sensor.texture_camera.project(inner).value()))
            << p.transpose();
      }
}

TEST_P(SensorModels, TriangulationAngleIsSevenDegrees) {
  for (const Pattern pattern : kPatterns) {
    const Vec3 to_projector = sensor.projector(pattern).center().normalized();
    const double angle_rad = std::acos(to_projector.dot(sensor.camera.center().normalized()));
    EXPECT_NEAR(angle_rad * 180.0 / std::numbers::pi, 7.0, 0.1);
  }
}

double across_in_row(const SensorModel& sensor, Pattern pattern, int n, double row, double z_mm) {
  const ProjectorModel& projector = sensor.projector(pattern);
  return across_in_row(sensor, projector, projector.line_across[n], row, z_mm);
}

TEST_P(SensorModels, LinesHaveSeparateImageAreasInTheVolume) {
  const double half_depth_mm = 0.5 * sensor.volume.size_mm.z();
  for (const Pattern pattern : kPatterns) {
    const int rows =
        pattern == Pattern::kVertical ? sensor.camera.size.height_px : sensor.camera.size.width_px;
    const int lines = sensor.projector(pattern).line_count();
    for (int row = 10; row < rows; row += 50)
      for (int n = 0; n + 1 < lines; ++n) {
        const double near_0 = across_in_row(sensor, pattern, n, row, -half_depth_mm);
        const double far_0 = across_in_row(sensor, pattern, n, row, half_depth_mm);
        const double near_1 = across_in_row(sensor, pattern, n + 1, row, -half_depth_mm);
        const double far_1 = across_in_row(sensor, pattern, n + 1, row, half_depth_mm);
        EXPECT_GT(std::min(near_1, far_1) - std::max(near_0, far_0), 2.0)
            << to_string(pattern) << " lines " << n << " and " << n + 1 << " in row " << row;
      }
  }
}

TEST_P(SensorModels, AreValid) { EXPECT_TRUE(sensor.validate()); }

INSTANTIATE_TEST_SUITE_P(Both, SensorModels, ::testing::Values(&intraoral_sensor, &face_sensor));

TEST(SensorModel, ReportsTheInvalidPart) {
  SensorModel sensor = intraoral_sensor();
  sensor.texture_camera.focal_px = -1.0;
  ASSERT_FALSE(sensor.validate());
  EXPECT_NE(sensor.validate().error().message.find("texture_camera.focal_px"), std::string::npos);
}

}  // namespace
}  // namespace flytri::simulated
