#include "hw/simulated/optics/view_simulator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "core/base/workers.h"
#include "tests/support/sample_meshes.h"

namespace flytri::simulated {
namespace {

// A bumpy surface through most of the depth of the intra-oral volume; the bumps face the sensor.
TriangleMesh bumpy_patch() {
  return height_field({.half_width_mm = 12.0, .step_mm = 0.25}, [](double x, double y) {
    return 2.0 * std::sin(0.5 * x) * std::cos(0.6 * y) + 0.1 * x;
  });
}

ViewSimulator simulator_of(const TriangleMesh& mesh) {
  return ViewSimulator::create(mesh, intraoral_sensor()).value();
}

// Signed distance of a point to the triangle of the height field below it.
double distance_to_hit(const RayScene& scene, const Vec3& p_model) {
  const Vec3 from = p_model - 5.0 * Vec3::UnitZ();
  const auto hit = scene.first_hit({from, Vec3::UnitZ()});
  return hit ? (hit->point_mm - p_model).dot(hit->normal) : 1.0;
}

TEST(ViewSimulator, PointsAreOnTheMesh) {
  const ViewSimulator simulator = simulator_of(bumpy_patch());
  const Isometry T_model_sensor =
      exp_twist((Twist() << 0.1, -0.05, 0.3, 0.4, -0.3, 1.0).finished());
  for (const Pattern pattern : kPatterns) {
    const View view = simulator.trace(pattern, T_model_sensor);
    ASSERT_GT(view.point_count(), 2000U);
    for (const Profile& profile : view.profiles)
      for (const ProfilePoint& point : profile.points)
        // Tolerance for ray casting in single precision at coordinates of some 10 mm.
        EXPECT_NEAR(distance_to_hit(simulator.scene(), T_model_sensor * point.position_mm), 0.0,
                    1e-5);
  }
}

TEST(ViewSimulator, PointsAreOnTheirLightSheet) {
  const ViewSimulator simulator = simulator_of(bumpy_patch());
  for (const Pattern pattern : kPatterns) {
    const ProjectorModel& projector = simulator.sensor().projector(pattern);
    for (const Profile& profile : simulator.trace(pattern, Isometry::Identity()).profiles)
      for (const ProfilePoint& point : profile.points) {
        const Vec2 place = projector.slide_place(point.position_mm).value();
        // Corresponds to about 1e-5 mm at 80 mm.
        EXPECT_NEAR(place.x(), projector.line_across[profile.line.at()], 2e-7);
        // The projector's distortion bends a sheet by some micrometers.
        const Vec3 from_projector = point.position_mm - projector.center();
        EXPECT_NEAR(profile.sheet_normal.dot(from_projector), 0.0, 0.02);
      }
  }
}

TEST(ViewSimulator, PointsAreInIncreasingWholeRows) {
  const ViewSimulator simulator = simulator_of(bumpy_patch());
  for (const Pattern pattern : kPatterns)
    for (const Profile& profile : simulator.trace(pattern, Isometry::Identity()).profiles) {
      float last_px = profile.points.front().along_px - 1.0F;
      for (const ProfilePoint& point : profile.points) {
        const Pixel pixel = simulator.sensor().camera.project(point.position_mm).value();
        EXPECT_NEAR(to_line_pixel(pattern, pixel).along_px, point.along_px, 0.021);
        EXPECT_EQ(point.along_px, last_px + 1.0F);
        last_px = point.along_px;
      }
    }
}

TEST(ViewSimulator, AStepSplitsProfilesAndHidesSurface) {
  // One half is 4 mm deeper: the edge hides a strip from the projector or the camera.
  const TriangleMesh mesh = height_field({.half_width_mm = 12.0, .step_mm = 0.1},
                                         [](double, double y) { return y < 0.05 ? -2.0 : 2.0; });
  const View view = simulator_of(mesh).trace(Pattern::kVertical, Isometry::Identity());
  std::set<int> lines;
  for (const Profile& profile : view.profiles) {
    lines.insert(profile.line.value);
    const double first_z_mm = profile.points.front().position_mm.z();
    for (const ProfilePoint& point : profile.points)
      EXPECT_NEAR(point.position_mm.z(), first_z_mm, 0.5) << "a profile bridges the step";
  }
  EXPECT_EQ(lines.size(), 10U);
  EXPECT_GE(view.profiles.size(), 20U);
}

TEST(ViewSimulator, SurfaceOutsideTheVolumeIsNotMeasured) {
  const ViewSimulator simulator = simulator_of(bumpy_patch());
  Isometry T_model_sensor = Isometry::Identity();
  T_model_sensor.translation().z() = -12.0;
  EXPECT_EQ(simulator.trace(Pattern::kVertical, T_model_sensor).point_count(), 0U);
}

TEST(ViewSimulator, IsBitIdenticalForAnyNumberOfThreads) {
  const ViewSimulator simulator = simulator_of(bumpy_patch());
  std::vector<View> views(8);
  const auto trace_one = [&](std::size_t i) {
    views[i] = simulator.trace(Pattern::kHorizontal, Isometry::Identity());
  };
  Workers(4).for_each(views.size(), trace_one);
  for (const View& view : views) {
    ASSERT_EQ(view.profiles.size(), views[0].profiles.size());
    for (std::size_t k = 0; k < view.profiles.size(); ++k)
      for (std::size_t i = 0; i < view.profiles[k].points.size(); ++i)
        EXPECT_EQ(view.profiles[k].points[i].position_mm,
                  views[0].profiles[k].points[i].position_mm);
  }
}

TEST(ViewSimulator, RefusesAnEmptyMeshAndBadOptions) {
  EXPECT_EQ(ViewSimulator::create({}, intraoral_sensor()).error().code, ErrorCode::kInsufficient);
  const auto bad = ViewSimulator::create(bumpy_patch(), intraoral_sensor(), {.max_stretch = 0.5});
  ASSERT_FALSE(bad);
  EXPECT_NE(bad.error().message.find("max_stretch"), std::string::npos);
}

}  // namespace
}  // namespace flytri::simulated
