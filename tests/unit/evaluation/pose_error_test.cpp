#include "core/evaluation/pose_error.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/sample_meshes.h"
#include "tests/support/scan_scene.h"

namespace flytri::evaluation {
namespace {

using testing::scan_cusps;
using testing::SceneSensor;

std::vector<Isometry> poses_of(const std::vector<AlignedView>& views) {
  std::vector<Isometry> poses;
  for (const AlignedView& view : views) poses.push_back(view.T_world_sensor);
  return poses;
}

Isometry moved(double angle_rad, const Vec3& t_mm) {
  Twist twist;
  twist << angle_rad * Vec3(0.3, -0.5, 0.8).normalized(), t_mm;
  return exp_twist(twist);
}

// True poses along a path; the estimated poses are in another world frame.
std::vector<PosePair> path(const Isometry& T_world_model) {
  std::vector<PosePair> views;
  for (int i = 0; i < 20; ++i) {
    const Isometry T_model_sensor = moved(0.05 * i, Vec3(1.5 * i, 0.2 * i, 0.0));
    views.push_back({T_world_model * T_model_sensor, T_model_sensor});
  }
  return views;
}

const std::vector<Vec3> kCorners = volume_corners(Vec3(20.0, 15.0, 15.0));

TEST(PoseErrorAtPoints, AnotherWorldFrameCausesNoError) {
  const PoseError error = pose_error(path(moved(1.0, Vec3(5, -40, 9))), kCorners);
  EXPECT_NEAR(error.first_view_mm, 0.0, 1e-10);
  EXPECT_NEAR(error.best_fit_mm, 0.0, 1e-10);
}

TEST(PoseErrorAtPoints, MeasuresAShiftOfHalfTheViews) {
  std::vector<PosePair> views = path(Isometry::Identity());
  const Vec3 shift_mm(0.0, 0.0, 0.1);
  // Every second view, so that to first order no rotation can compensate the shift.
  for (std::size_t i = 1; i < views.size(); i += 2)
    views[i].T_world_sensor = Eigen::Translation3d(shift_mm) * views[i].T_world_sensor;
  const PoseError error = pose_error(views, kCorners);
  EXPECT_NEAR(error.first_view_mm, 0.1 / std::sqrt(2.0), 1e-10);
  // A common shift by half leaves 0.05 mm everywhere; a rotation compensates a few percent of it.
  EXPECT_LE(error.best_fit_mm, 0.05);
  EXPECT_GT(error.best_fit_mm, 0.045);
}

TEST(PoseErrorAtPoints, AWrongFirstViewAffectsOnlyTheFirstViewGauge) {
  std::vector<PosePair> views = path(Isometry::Identity());
  views[0].T_world_sensor = views[0].T_world_sensor * moved(0.01, Vec3::Zero());
  const PoseError error = pose_error(views, kCorners);
  EXPECT_GT(error.first_view_mm, 5.0 * error.best_fit_mm);
}

TEST(PoseErrorAtPoints, IsZeroWithoutViews) {
  EXPECT_EQ(pose_error({}, kCorners).first_view_mm, 0.0);
  EXPECT_EQ(pose_error({}, kCorners).best_fit_mm, 0.0);
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

TEST(PoseError, AMotionOfTheWholeWorldCausesNoError) {
  auto views = scan_cusps(4, SceneSensor{}, 1).views;
  const auto truth = poses_of(views);
  Twist twist;
  twist << 0.1, 0.2, -0.1, 3, -2, 1;
  for (AlignedView& view : views) view.T_world_sensor = exp_twist(twist) * view.T_world_sensor;
  const PoseError error = pose_error(views, truth);
  EXPECT_NEAR(error.first_view_mm, 0.0, 1e-9);
  EXPECT_NEAR(error.best_fit_mm, 0.0, 1e-9);
}

TEST(PoseError, AnErrorOfTheFirstViewMovesTheOthersInItsGauge) {
  auto views = scan_cusps(10, SceneSensor{}, 2).views;
  const auto truth = poses_of(views);
  views[0].T_world_sensor.translation().x() += 0.1;
  const PoseError error = pose_error(views, truth);
  // In the first-view gauge, nine of ten views have an error of 0.1 mm. The best fit has a tenth of
  // the mean square.
  EXPECT_NEAR(error.first_view_mm, 0.1 * std::sqrt(0.9), 0.01);
  EXPECT_LT(error.best_fit_mm, 0.035);
}

TEST(PoseErrorsByView, NameTheViewThatIsOff) {
  auto views = scan_cusps(10, SceneSensor{}, 2).views;
  const auto truth = poses_of(views);
  Twist twist;
  twist << 0.1, 0.2, -0.1, 3, -2, 1;
  for (AlignedView& view : views) view.T_world_sensor = exp_twist(twist) * view.T_world_sensor;
  for (const double error_mm : pose_errors_by_view_mm(views, truth)) EXPECT_LT(error_mm, 1e-9);
  views[3].T_world_sensor.translation().x() += 0.1;
  const auto errors_mm = pose_errors_by_view_mm(views, truth);
  ASSERT_EQ(errors_mm.size(), 10U);
  // The best fit follows the nine others, but for about a tenth of the shift.
  for (std::size_t i = 0; i < errors_mm.size(); ++i) {
    EXPECT_EQ(errors_mm[i] > 0.06, i == 3) << errors_mm[i];
  }
}

TEST(PointError, EqualsTheNoiseIfThePosesAreRight) {
  SceneSensor ideal_sensor;
  ideal_sensor.noise_mm = 1e-9;
  const auto ideal = scan_cusps(6, ideal_sensor, 3).views;
  auto noisy = ideal;
  std::vector<std::shared_ptr<const View>> ideal_views;
  Random random(4);
  for (AlignedView& view : noisy) {
    ideal_views.push_back(view.view);
    View moved = *view.view;
    for (Profile& profile : moved.profiles) {
      for (ProfilePoint& point : profile.points) point.position_mm.z() += 0.03 * random.normal();
    }
    view.view = std::make_shared<const View>(std::move(moved));
  }
  EXPECT_NEAR(point_error_mm(noisy, ideal_views, poses_of(ideal)), 0.03, 0.001);
}

}  // namespace
}  // namespace flytri::evaluation
