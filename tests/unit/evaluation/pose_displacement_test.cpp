#include "core/evaluation/pose_displacement.h"

#include <gtest/gtest.h>

#include <cmath>

namespace flytri {
namespace {

Isometry moved(double angle_rad, const Vec3& t_mm) {
  Twist twist;
  twist << angle_rad * Vec3(0.3, -0.5, 0.8).normalized(), t_mm;
  return exp_twist(twist);
}

// True poses along a path; the found ones lie in a world of their own.
std::vector<PosePair> path(const Isometry& T_world_model) {
  std::vector<PosePair> views;
  for (int i = 0; i < 20; ++i) {
    const Isometry T_model_sensor = moved(0.05 * i, Vec3(1.5 * i, 0.2 * i, 0.0));
    views.push_back({T_world_model * T_model_sensor, T_model_sensor});
  }
  return views;
}

const std::vector<Vec3> kCorners = volume_corners(Vec3(20.0, 15.0, 15.0));

TEST(PoseDisplacement, AnotherWorldFrameIsNoError) {
  const PoseDisplacement displacement =
      pose_displacement(path(moved(1.0, Vec3(5, -40, 9))), kCorners).value();
  EXPECT_NEAR(displacement.first_view_mm, 0.0, 1e-10);
  EXPECT_NEAR(displacement.best_fit_mm, 0.0, 1e-10);
}

TEST(PoseDisplacement, AShiftOfHalfTheViewsIsFoundAsItIs) {
  std::vector<PosePair> views = path(Isometry::Identity());
  const Vec3 shift_mm(0.0, 0.0, 0.1);
  // First and second in turn, so that no rotation can take up the shift to first order.
  for (std::size_t i = 1; i < views.size(); i += 2)
    views[i].T_world_sensor = Eigen::Translation3d(shift_mm) * views[i].T_world_sensor;
  const PoseDisplacement displacement = pose_displacement(views, kCorners).value();
  EXPECT_NEAR(displacement.first_view_mm, 0.1 / std::sqrt(2.0), 1e-10);
  // A common shift by half leaves 0.05 mm everywhere; a rotation takes up a few per cent of it.
  EXPECT_LE(displacement.best_fit_mm, 0.05);
  EXPECT_GT(displacement.best_fit_mm, 0.045);
}

TEST(PoseDisplacement, AWrongFirstViewCostsTheFirstGaugeAlone) {
  std::vector<PosePair> views = path(Isometry::Identity());
  views[0].T_world_sensor = views[0].T_world_sensor * moved(0.01, Vec3::Zero());
  const PoseDisplacement displacement = pose_displacement(views, kCorners).value();
  EXPECT_GT(displacement.first_view_mm, 5.0 * displacement.best_fit_mm);
}

TEST(PoseDisplacement, RefusesTooLittle) {
  EXPECT_EQ(pose_displacement({}, kCorners).error().code, ErrorCode::kInsufficient);
  EXPECT_EQ(pose_displacement(path(Isometry::Identity()), {Vec3::Zero()}).error().code,
            ErrorCode::kInsufficient);
}

TEST(VolumeCorners, SpanTheBoxAroundTheOrigin) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& corner : kCorners) {
    EXPECT_EQ(corner.cwiseAbs(), Vec3(10.0, 7.5, 7.5));
    sum += corner;
  }
  EXPECT_EQ(kCorners.size(), 8U);
  EXPECT_EQ(sum, Vec3(0.0, 0.0, 0.0));
}

}  // namespace
}  // namespace flytri
