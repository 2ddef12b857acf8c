#include "hw/simulated/optics/sensor_path.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "assets/sample_face/sample_face.h"
#include "assets/sample_jaw/sample_jaw.h"
#include "core/geometry/sphere_mesh.h"
#include "core/io/recordings/truth.h"
#include "hw/simulated/optics/view_simulator.h"
#include "tests/support/temporary_folder.h"

namespace flytri::simulated {
namespace {

TriangleMesh coarse_jaw() {
  return sample_jaw::make_sample_jaw({.tooth_cell_mm = 0.4, .gum_cell_mm = 0.6}, Workers()).value();
}

// Smallest and mean number of points of the views along a path.
struct PointCounts {
  std::size_t fewest = 1000000;
  double mean = 0.0;
};
PointCounts count_points(const ViewSimulator& simulator, const SensorPath& path, int views) {
  PointCounts counts;
  for (int i = 0; i < views; ++i) {
    const double time_s = path.start_s() + (path.end_s() - path.start_s()) * i / (views - 1);
    const Pattern pattern = kPatterns[i % 2];
    const std::size_t count = simulator.trace(pattern, path.T_model_sensor(time_s)).point_count();
    counts.fewest = std::min(counts.fewest, count);
    counts.mean += static_cast<double>(count) / views;
  }
  return counts;
}

TEST(SensorPath, InterpolatesAndRestsBeforeAndAfter) {
  Isometry T = Isometry::Identity();
  T.translation() = Vec3(2.0, 0.0, 0.0);
  const auto path = SensorPath::from_poses({{1.0, Isometry::Identity()}, {2.0, T}}).value();
  EXPECT_EQ(path.T_model_sensor(0.0).translation().x(), 0.0);
  EXPECT_NEAR(path.T_model_sensor(1.25).translation().x(), 0.5, 1e-12);
  EXPECT_EQ(path.T_model_sensor(9.0).translation().x(), 2.0);
}

TEST(SensorPath, RefusesTimesThatDoNotIncrease) {
  const auto path =
      SensorPath::from_poses({{1.0, Isometry::Identity()}, {1.0, Isometry::Identity()}});
  EXPECT_EQ(path.error().code, ErrorCode::kBadOption);
}

TEST(SensorPath, ArchKeepsTheSurfaceOfAJawInTheVolume) {
  const auto simulator = ViewSimulator::create(coarse_jaw(), intraoral_sensor()).value();
  for (const PathKind kind : {PathKind::kArch, PathKind::kQuadrant}) {
    const auto path = plan_path(simulator.scene(), simulator.sensor(), {.kind = kind}).value();
    const PointCounts counts = count_points(simulator, path, 60);
    // The paper's views have 4,500 points; views with only some hundreds cannot be registered.
    EXPECT_GT(counts.fewest, 1000U);
    EXPECT_GT(counts.mean, 3500.0);
    EXPECT_LT(counts.mean, 6500.0);
  }
}

TEST(SensorPath, OrbitKeepsTheSurfaceOfAHeadInTheVolume) {
  const auto simulator =
      ViewSimulator::create(sphere_mesh(Vec3(10.0, -20.0, 30.0), 90.0, 60), face_sensor()).value();
  const auto path =
      plan_path(simulator.scene(), simulator.sensor(), {.kind = PathKind::kOrbit}).value();
  EXPECT_GT(count_points(simulator, path, 30).fewest, 2000U);
}

TEST(SensorPath, FromTheFrontTheSurfaceOfAFaceStaysInTheVolume) {
  const auto simulator =
      ViewSimulator::create(sample_face::make_sample_face({.cell_mm = 3.0}).value(), face_sensor())
          .value();
  const auto path =
      plan_path(simulator.scene(), simulator.sensor(), {.kind = PathKind::kFront}).value();
  EXPECT_GT(count_points(simulator, path, 30).fewest, 1500U);
}

TEST(SensorPath, MovesLikeAHand) {
  const RayScene scene(coarse_jaw());
  const auto path = plan_path(scene, intraoral_sensor(), {}).value();
  for (double time_s = 0.0; time_s < path.end_s() - 0.034; time_s += 0.1) {
    const Isometry T_then_now =
        path.T_model_sensor(time_s).inverse() * path.T_model_sensor(time_s + 1.0 / 30.0);
    // 60 mm/s and 120 °/s are fast for a scanning hand.
    EXPECT_LT(T_then_now.translation().norm(), 2.0) << "at " << time_s << " s";
    EXPECT_LT(rotation_angle(T_then_now), 0.07) << "at " << time_s << " s";
  }
}

TEST(SensorPath, DependsOnTheSeed) {
  const RayScene scene(coarse_jaw());
  const auto at = [&](std::uint64_t seed) {
    return plan_path(scene, intraoral_sensor(), {.seed = seed})
        .value()
        .T_model_sensor(7.0)
        .matrix();
  };
  EXPECT_EQ(at(1), at(1));
  EXPECT_NE(at(1), at(2));
}

TEST(SensorPath, IsReadFromATruthFile) {
  const TemporaryFolder folder;
  io::Truth truth;
  truth.mesh = "jaw.ply";
  Isometry T = exp_twist((Twist() << 0.1, 0.2, 0.3, 1.0, 2.0, 3.0).finished());
  truth.poses = {{FrameIndex(0), "a.png", 0.5, Isometry::Identity()},
                 {FrameIndex(1), "b.png", 1.5, T}};
  ASSERT_TRUE(io::write_truth(folder.path() / "truth.json", truth));
  const auto path = read_path(folder.path() / "truth.json").value();
  EXPECT_EQ(path.start_s(), 0.5);
  EXPECT_TRUE(path.T_model_sensor(1.5).isApprox(T, 1e-12));
}

TEST(SensorPath, RefusesBadOptionsAndReportsAMissingSurface) {
  const RayScene scene(coarse_jaw());
  const auto bad = plan_path(scene, intraoral_sensor(), {.duration_s = -1.0});
  ASSERT_FALSE(bad);
  EXPECT_NE(bad.error().message.find("duration_s"), std::string::npos);
}

}  // namespace
}  // namespace flytri::simulated
