#include "app/lab/enamel_scene.h"

#include <gtest/gtest.h>

#include <cmath>

namespace flytri::lab {
namespace {

const simulated::SensorModel kSensor = simulated::intraoral_sensor();

TEST(EnamelScene, TheMeshIsTheSurfaceAndFacesTheSensor) {
  for (const EnamelScene& scene :
       {tilted_plane(kSensor, 2.0, -60.0), tilted_plane(kSensor, 2.0, 30.0),
        glossy_cusp(kSensor, -4.5, 0.1)}) {
    for (const SurfacePoint& vertex : scene.mesh.vertices)
      ASSERT_NEAR(scene.below_mm(vertex.position_mm.cast<double>()), 0.0, 1e-5);
    const Triangle& first = scene.mesh.triangles.front();
    const auto corner = [&](int i) { return scene.mesh.vertices[first[i]].position_mm; };
    const Vec3f normal = (corner(1) - corner(0)).cross(corner(2) - corner(0));
    EXPECT_GT(normal.dot(scene.mesh.vertices[first[0]].normal), 0.0F);
    EXPECT_LT(scene.plane.normal.z(), 0.0);
    EXPECT_TRUE(scene.is_measured(scene.plane.p_sensor));
    EXPECT_FALSE(scene.is_measured(scene.plane.p_sensor + 5.0 * Vec3::UnitX()));
    EXPECT_NEAR(scene.below_mm(scene.plane.p_sensor - 0.02 * scene.plane.normal), 0.02, 1e-9);
  }
}

TEST(EnamelScene, APlaneTiltedAwayIsLitAtASteeperAngle) {
  const Vec3 projector = kSensor.projector(kEnamelPattern).center().normalized();
  const auto cosine = [&](double tilt_degrees) {
    return tilted_plane(kSensor, 0.0, tilt_degrees).plane.normal.dot(projector);
  };
  EXPECT_GT(cosine(-30.0), cosine(30.0) + 0.1);
}

TEST(EnamelScene, TheHighlightIsWhereTheCuspMirrorsTheProjectorIntoTheCamera) {
  const EnamelScene scene = glossy_cusp(kSensor, 0.0, 0.1);
  const Vec3 from = scene.plane.p_sensor - kSensor.projector(kEnamelPattern).center();
  const Vec3 mirrored = from - 2.0 * from.dot(scene.plane.normal) * scene.plane.normal;
  const Vec3 to_camera = kSensor.camera.center() - scene.plane.p_sensor;
  EXPECT_LT(mirrored.normalized().cross(to_camera.normalized()).norm(), 1e-9);
}

}  // namespace
}  // namespace flytri::lab
