#include "core/evaluation/pose_error.h"

#include <gtest/gtest.h>

#include "tests/support/sample_meshes.h"
#include "tests/support/scan_scene.h"

namespace flytri {
namespace {

using testing::scan_cusps;
using testing::SceneSensor;

std::vector<Isometry> poses_of(const std::vector<AlignedView>& views) {
  std::vector<Isometry> poses;
  for (const AlignedView& view : views) poses.push_back(view.T_world_sensor);
  return poses;
}

TEST(PoseError, AMotionOfTheWholeWorldIsNoError) {
  auto views = scan_cusps(4, SceneSensor{}, 1).views;
  const auto truth = poses_of(views);
  Twist twist;
  twist << 0.1, 0.2, -0.1, 3, -2, 1;
  for (AlignedView& view : views) view.T_world_sensor = exp_twist(twist) * view.T_world_sensor;
  const PoseError error = pose_error(views, truth);
  EXPECT_NEAR(error.first_view_mm, 0.0, 1e-9);
  EXPECT_NEAR(error.best_fit_mm, 0.0, 1e-9);
}

TEST(PoseError, AnErrorOfTheFirstViewAloneMovesTheRestInItsGauge) {
  auto views = scan_cusps(10, SceneSensor{}, 2).views;
  const auto truth = poses_of(views);
  views[0].T_world_sensor.translation().x() += 0.1;
  const PoseError error = pose_error(views, truth);
  // Nine of ten views are 0.1 mm off as it stands; the best fit leaves a tenth of that, and sqrt.
  EXPECT_NEAR(error.first_view_mm, 0.1 * std::sqrt(0.9), 0.01);
  EXPECT_LT(error.best_fit_mm, 0.035);
}

TEST(PointError, IsTheNoiseWhereThePosesAreRight) {
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
}  // namespace flytri
