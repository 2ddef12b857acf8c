#include "core/texture/shading.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/perspective_calibration.h"

namespace flytri::texture {
namespace {

calibration::Calibration perspective() {
  return testing::perspective_calibration({20, 15, 15}, {1280, 960}, 45.0, 80.0);
}

TEST(Shading, TheEyeIsWhereTheRaysOfSightMeet) {
  // The cubic is a perspective to second order only.
  EXPECT_LT((texture_eye(perspective()) - Vec3(0, 0, -80)).norm(), 2.0);
}

TEST(Shading, TheEyeOfACameraWithoutPerspectiveIsFarAway) {
  const auto parallel = testing::orthographic_calibration({20, 15, 15}, {640, 480}, 20.0);
  const Vec3 eye_mm = texture_eye(parallel);
  EXPECT_LT(eye_mm.z(), -10000.0);
  EXPECT_LT(eye_mm.head<2>().norm() / eye_mm.norm(), 1e-3);
}

TEST(Shading, WithoutAFlashTheLampIsAtTheCameraAndTheMiddleKeepsItsBrightness) {
  const Shading shading(perspective());
  const Shading::Incidence middle = shading.incidence(Vec3::Zero(), -Vec3::UnitZ(), 0.0);
  EXPECT_NEAR(middle.light, 1.0, 1e-9);
  EXPECT_NEAR(middle.lamp_cosine, 1.0, 1e-3);
  EXPECT_NEAR(middle.eye_cosine, 1.0, 1e-3);
  // 8 mm behind the middle, the light is spread over a larger sphere.
  const Shading::Incidence behind = shading.incidence({0, 0, 8}, -Vec3::UnitZ(), 0.0);
  EXPECT_NEAR(behind.light, std::pow(80.0 / 88.0, 2), 5e-3);
}

/// The formula of calibration::Flash.
TEST(Shading, ACalibratedFlashLightsAsDocumented) {
  calibration::Calibration calibration = perspective();
  calibration.flash = calibration::Flash{{30, -10, -60}, {0.3, 0.2, 0.1}, 0.25, {}};
  const Shading shading(calibration);
  const Vec3 p(2, 3, 4), normal = Vec3(0.2, 0.1, -1).normalized();
  const Vec3 to_lamp = Vec3(30, -10, -60) - p;
  const double rho2 = 0.5;
  const Shading::Incidence seen = shading.incidence(p, normal, rho2);
  EXPECT_NEAR(seen.lamp_cosine, normal.dot(to_lamp.normalized()), 1e-12);
  EXPECT_NEAR(seen.light, 0.2 * 1e4 / to_lamp.squaredNorm() * (1.0 - 0.25 * rho2), 1e-12);
  EXPECT_NEAR(shading.channels()[0], 1.5, 1e-6);
  EXPECT_NEAR(shading.channels()[2], 0.5, 1e-6);
}

}  // namespace
}  // namespace flytri::texture
