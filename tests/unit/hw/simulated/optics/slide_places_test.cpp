#include "hw/simulated/optics/slide_places.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"
#include "hw/simulated/optics/lens_blur.h"
#include "hw/simulated/optics/slide_light.h"
#include "tests/support/sample_meshes.h"

namespace flytri::simulated {
namespace {

// Eight points at once in single precision give the same as single points in double precision.
TEST(SlidePlaces, AgreeWithSlideLightPoint) {
  const SensorModel sensor = intraoral_sensor();
  const RayScene scene(height_field({.half_width_mm = 9.0, .step_mm = 0.3}, [](double x, double y) {
    return 3.0 * std::sin(0.6 * x) * std::cos(0.5 * y);
  }));
  Isometry T_model_sensor = Isometry::Identity();
  T_model_sensor.rotate(Eigen::AngleAxisd(0.2, Vec3(0.3, 0.9, 0.1).normalized()));
  const LensBlur blur(sensor.camera, 70.0, 100.0);
  const LineExposure exposure{scene, {}, {}, blur, T_model_sensor, {Isometry::Identity()}};
  const Vec3 camera = sensor.camera.center();
  Random random(1);
  for (const Pattern pattern : kPatterns) {
    const SlideLight slide(sensor, pattern);
    const SlidePlaces eight(sensor.projector(pattern), camera);
    int seen = 0, missed = 0;
    for (int round = 0; round < 200; ++round) {
      std::array<Vec3f, RayPacket::kSize> rays;
      for (Vec3f& ray : rays)
        ray = sensor.camera.direction({random.uniform(0.0, 1023.0), random.uniform(0.0, 767.0)})
                  .cast<float>();
      RayPacket packet;
      packet.aim(rays);
      scene.first_hits(T_model_sensor, camera, packet);
      const SlidePlaces::Places places = eight.find(packet);
      for (int i = 0; i < RayPacket::kSize; ++i) {
        const Vec3 view = rays[i].cast<double>();
        const auto hit = scene.first_hit({T_model_sensor * camera, T_model_sensor.linear() * view});
        const auto point = hit ? slide.point(exposure, view, *hit) : std::nullopt;
        ASSERT_EQ(places.seen[i], point.has_value());
        (point ? seen : missed) += 1;
        if (!point) continue;
        // 1e-6 corresponds to 0.004 px (focal length about 4300 px).
        EXPECT_NEAR(places.across[i], point->across, 1e-6);
        EXPECT_NEAR(places.offset[i], slide.from_nearest_line(point->across), 1e-6);
        EXPECT_NEAR(places.blur[i], point->blur, 1e-6);
        EXPECT_NEAR(places.facing[i], -point->normal.dot(point->view), 1e-4);
        EXPECT_NEAR(packet.distances_mm[i], (point->position_mm - camera).norm(), 1e-3);
      }
    }
    EXPECT_GT(seen, 500);
    EXPECT_GT(missed, 20);
  }
}

}  // namespace
}  // namespace flytri::simulated
