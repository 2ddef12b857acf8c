#include "ui/scene/orbit_camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "ui/scene/box_corners.h"

namespace flytri::ui {
namespace {

constexpr PictureSize kSize = {1280, 800};

CameraPose some_pose() {
  CameraPose pose;
  pose.target_mm = Vec3(3.0, -4.0, 12.0);
  pose.q_world_eye = Eigen::Quaterniond(0.5, -0.2, 0.7, 0.1).normalized();
  pose.height_mm = 50.0;
  return pose;
}

OrbitCamera some_camera() {
  OrbitCamera camera;
  camera.set_pose(some_pose());
  return camera;
}

/// Pixel coordinates from the upper left, and the depth in front of the eye.
Vec3 seen_at(const OrbitCamera& camera, const Vec3& p_world) {
  const Vec3 p_eye = camera.T_world_eye().inverse() * p_world;
  const Eigen::Vector4d clip = camera.projection(kSize.aspect(), 1.0, 1e4) * p_eye.homogeneous();
  return {(0.5 + 0.5 * clip.x() / clip.w()) * kSize.width_px - 0.5,
          (0.5 - 0.5 * clip.y() / clip.w()) * kSize.height_px - 0.5, clip.w()};
}

TEST(OrbitCamera, ShowsTheTargetInTheMiddleAndTheHeightFromEdgeToEdge) {
  const OrbitCamera camera = some_camera();
  const Vec3 middle = seen_at(camera, some_pose().target_mm);
  EXPECT_NEAR(middle.x(), 639.5, 1e-9);
  EXPECT_NEAR(middle.y(), 399.5, 1e-9);
  EXPECT_NEAR(middle.z(), camera.distance_mm(), 1e-9);
  const Vec3 up = some_pose().q_world_eye * Vec3(0.0, 25.0, 0.0);
  EXPECT_NEAR(seen_at(camera, some_pose().target_mm + up).y(), -0.5, 1e-9) << "upper border";
}

TEST(OrbitCamera, ARayPassesThroughThePointSeenAtItsPixel) {
  const OrbitCamera camera = some_camera();
  const Vec3 p_world(8.0, 1.0, 5.0);
  const Vec3 pixel = seen_at(camera, p_world);
  EXPECT_LT(camera.ray(pixel.x(), pixel.y(), kSize).distance(p_world), 1e-9);
}

TEST(OrbitCamera, TheModelTurnsAboutTheGivenPoint) {
  OrbitCamera camera = some_camera();
  const Vec3 pivot_mm(8.0, 1.0, 5.0);
  const Vec3 before = seen_at(camera, pivot_mm);
  camera.orbit(70.0, -30.0, kSize, pivot_mm);
  EXPECT_LT((seen_at(camera, pivot_mm) - before).norm(), 1e-9) << "it stays under the pointer";
  EXPECT_GT(camera.pose().q_world_eye.angularDistance(some_pose().q_world_eye), 0.1);
}

TEST(OrbitCamera, OrbitTurnsTheModelWithThePointer) {
  OrbitCamera camera = some_camera();
  const Vec3 towards_eye = some_pose().q_world_eye * Vec3::UnitZ();
  const Vec3 front = some_pose().target_mm + 2.0 * towards_eye;
  camera.orbit(10.0, 20.0, kSize);
  EXPECT_EQ(camera.pose().target_mm, some_pose().target_mm);
  EXPECT_NEAR(camera.distance_mm(), some_camera().distance_mm(), 1e-12);
  const Vec3 moved = seen_at(camera, front);
  EXPECT_GT(moved.x(), 639.5) << "dragged right, the front goes right";
  EXPECT_GT(moved.y(), 399.5) << "dragged down, the front goes down";
}

TEST(OrbitCamera, PanKeepsThePointUnderThePointer) {
  OrbitCamera camera = some_camera();
  const Vec3 before = seen_at(camera, some_pose().target_mm);
  camera.pan(100.0, -40.0, kSize);
  const Vec3 after = seen_at(camera, some_pose().target_mm);
  EXPECT_NEAR(after.x() - before.x(), 100.0, 1e-6);
  EXPECT_NEAR(after.y() - before.y(), -40.0, 1e-6);
}

TEST(OrbitCamera, ZoomKeepsThePointUnderThePointer) {
  OrbitCamera camera = some_camera();
  // A place in the target's plane, off the middle.
  const Vec3 place = some_pose().target_mm + some_pose().q_world_eye * Vec3(10.0, 6.0, 0.0);
  const Vec3 before = seen_at(camera, place);
  camera.zoom_at(1.7, before.x(), before.y(), kSize);
  EXPECT_NEAR(camera.pose().height_mm, 50.0 / 1.7, 1e-9);
  const Vec3 after = seen_at(camera, place);
  EXPECT_NEAR(after.x(), before.x(), 0.5) << "half a pixel: the pointer is in a pixel's middle";
  EXPECT_NEAR(after.y(), before.y(), 0.5);
}

TEST(OrbitCamera, ZoomStopsAtTheLimits) {
  OrbitCamera camera = some_camera();
  for (int i = 0; i < 100; ++i) camera.zoom(2.0);
  EXPECT_EQ(camera.pose().height_mm, camera.options().min_height_mm);
  for (int i = 0; i < 100; ++i) camera.zoom(0.5);
  EXPECT_EQ(camera.pose().height_mm, camera.options().max_height_mm);
}

TEST(OrbitCamera, AFlightIsSmoothAndEndsAtItsPose) {
  OrbitCamera camera;
  const CameraPose start = camera.pose(), end = some_pose();
  camera.fly_to(end, 1.0);
  double longest_mm = 0.0;
  Vec3 before = start.target_mm;
  for (int frame = 0; frame < 29; ++frame) {
    EXPECT_TRUE(camera.advance(1.0 / 30.0));
    longest_mm = std::max(longest_mm, (camera.pose().target_mm - before).norm());
    before = camera.pose().target_mm;
  }
  // The steepest slope of 6s^5 - 15s^4 + 10s^3 is 15/8.
  EXPECT_LE(longest_mm, 1.875 / 30.0 * (end.target_mm - start.target_mm).norm() * 1.001);
  EXPECT_TRUE(camera.is_flying());
  EXPECT_TRUE(camera.advance(1.0));
  EXPECT_EQ(camera.pose().target_mm, end.target_mm);
  EXPECT_EQ(camera.pose().q_world_eye.coeffs(), end.q_world_eye.normalized().coeffs());
  EXPECT_EQ(camera.pose().height_mm, end.height_mm);
  EXPECT_FALSE(camera.is_flying());
  EXPECT_FALSE(camera.advance(1.0));
}

TEST(OrbitCamera, UserInputEndsAFlight) {
  OrbitCamera camera;
  camera.fly_to(some_pose(), 1.0);
  (void)camera.advance(0.5);
  camera.orbit(1.0, 0.0, kSize);
  EXPECT_FALSE(camera.is_flying());
}

TEST(OrbitCamera, FittingShowsTheWholeBoxAndLittleMore) {
  const Eigen::AlignedBox3d box(Vec3(-30.0, -5.0, 10.0), Vec3(40.0, 20.0, 70.0));
  for (const double field_of_view_rad : {0.02, 0.35, 1.2}) {
    OrbitCamera camera({.field_of_view_rad = field_of_view_rad});
    camera.set_pose(camera.fitting(corners_of(box), some_pose().q_world_eye, kSize));
    double widest = 0.0;
    for (int i = 0; i < 8; ++i) {
      const Vec3 p = seen_at(camera, box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i)));
      widest = std::max({widest, std::abs(p.x() - 639.5) / 640.0, std::abs(p.y() - 399.5) / 400.0});
    }
    EXPECT_LT(widest, 1.0) << field_of_view_rad;
    EXPECT_GT(widest, 0.9) << field_of_view_rad;
  }
}

TEST(OrbitCamera, TheViewThroughTheSensorMatchesItsImage) {
  const Isometry T_world_sensor =
      make_isometry(Eigen::Quaterniond(0.9, 0.1, -0.3, 0.2).normalized(), Vec3(5.0, 6.0, 7.0));
  OrbitCamera camera;
  camera.set_pose(pose_through_sensor(T_world_sensor, Vec3(20.0, 15.0, 15.0)));
  const Vec3 x = seen_at(camera, T_world_sensor * Vec3(5.0, 0.0, 0.0));
  const Vec3 y = seen_at(camera, T_world_sensor * Vec3(0.0, 5.0, 0.0));
  const Vec3 z = seen_at(camera, T_world_sensor * Vec3(0.0, 0.0, 5.0));
  EXPECT_GT(x.x(), 700.0);
  EXPECT_NEAR(x.y(), 399.5, 1e-6);
  EXPECT_GT(y.y(), 450.0) << "the sensor's y runs down";
  EXPECT_NEAR(z.z(), camera.distance_mm() + 5.0, 1e-9) << "its z runs away";
}

TEST(OrbitCamera, FacingLooksAlongTheInwardNormal) {
  const Vec3 normal = Vec3(1.0, 2.0, -1.0).normalized();
  const CameraPose pose = pose_facing(Vec3(1.0, 1.0, 1.0), normal, Vec3::UnitY(), 20.0);
  EXPECT_LT((pose.q_world_eye * Vec3::UnitZ() - normal).norm(), 1e-12);
  EXPECT_NEAR((pose.q_world_eye * Vec3::UnitX()).y(), 0.0, 1e-12) << "up stays upright";
  const CameraPose along = pose_facing(Vec3::Zero(), Vec3::UnitY(), Vec3::UnitY(), 20.0);
  EXPECT_LT((along.q_world_eye * Vec3::UnitZ() - Vec3::UnitY()).norm(), 1e-12);
}

TEST(OrbitCamera, OptionsNameTheBadField) {
  EXPECT_TRUE(CameraOptions{}.validate());
  const auto bad = CameraOptions{.field_of_view_rad = 3.0}.validate();
  ASSERT_FALSE(bad);
  EXPECT_NE(bad.error().message.find("field_of_view_rad"), std::string::npos);
  EXPECT_FALSE((CameraOptions{.min_height_mm = 5.0, .max_height_mm = 5.0}).validate());
}

}  // namespace
}  // namespace flytri::ui
