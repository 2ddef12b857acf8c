#include "hw/simulated/datasets/passing_tissue.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace flytri::simulated {
namespace {

/// Ten seconds along x.
SensorPath path() {
  return SensorPath::from_poses(
             {{0.0, Isometry::Identity()}, {10.0, Isometry(Eigen::Translation3d(30, 0, 0))}})
      .value();
}

bool is_in_volume(const TriangleMesh& body, double time_s) {
  const SensorModel sensor = intraoral_sensor();
  const Isometry T_sensor_model = path().T_model_sensor(time_s).inverse();
  return std::any_of(body.vertices.begin(), body.vertices.end(), [&](const SurfacePoint& vertex) {
    return sensor.volume.contains(T_sensor_model * vertex.position_mm.cast<double>());
  });
}

TEST(PassingTissue, IsInViewForItsShareOfTheTime) {
  const PassingTissue tissue(path(), intraoral_sensor(), 0.2, 1);
  int with_body = 0, in_volume = 0;
  for (int frame = 0; frame < 300; ++frame) {
    const TriangleMesh body = tissue.at(frame / 30.0);
    if (body.triangles.empty()) continue;
    ++with_body;
    in_volume += is_in_volume(body, frame / 30.0) ? 1 : 0;
  }
  EXPECT_NEAR(with_body, 60, 6);
  // It comes from outside, and leaves.
  EXPECT_GT(in_volume, with_body / 3);
  EXPECT_LT(in_volume, with_body);
}

TEST(PassingTissue, IsAnotherOneForEachSeed) {
  const PassingTissue one(path(), intraoral_sensor(), 0.5, 1);
  const PassingTissue same(path(), intraoral_sensor(), 0.5, 1);
  const PassingTissue other(path(), intraoral_sensor(), 0.5, 2);
  int differ = 0;
  for (int frame = 0; frame < 300; ++frame) {
    const double time_s = frame / 30.0;
    EXPECT_EQ(one.at(time_s).triangles.size(), same.at(time_s).triangles.size());
    differ += one.at(time_s).triangles.size() != other.at(time_s).triangles.size() ? 1 : 0;
  }
  EXPECT_GT(differ, 0);
}

TEST(PassingTissue, NeverComesWithoutAShare) {
  const PassingTissue tissue(path(), intraoral_sensor(), 0.0, 1);
  for (int frame = 0; frame < 300; ++frame) {
    EXPECT_TRUE(tissue.at(frame / 30.0).triangles.empty());
  }
}

}  // namespace
}  // namespace flytri::simulated
