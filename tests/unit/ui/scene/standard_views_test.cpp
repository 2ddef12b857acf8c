#include "ui/scene/standard_views.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace flytri::ui {
namespace {

/// A row of teeth along a parabola, y = -bend x^2 / half length: a ridge with two flanks. Occlusal
/// is +z, the lips lie towards +y.
SurfelModel arch(double half_length_mm, double bend, const Isometry& T_world_arch) {
  auto block = std::make_shared<SurfelBlock>();
  for (double x = -half_length_mm; x <= half_length_mm; x += 0.5) {
    const double y = -bend * x * x / half_length_mm;
    const Vec3 out = Vec3(2.0 * bend * x / half_length_mm, 1.0, 0.0).normalized();
    for (double around = -1.4; around <= 1.4; around += 0.1) {
      const Vec3 n = std::sin(around) * out + std::cos(around) * Vec3::UnitZ();
      Surfel s;
      s.position_mm = (T_world_arch * (Vec3(x, y, 0.0) + 4.0 * n)).cast<float>();
      s.normal = (T_world_arch.linear() * n).cast<float>();
      s.radius_mm = 0.4F;
      block->surfels.push_back(s);
    }
  }
  return {block};
}

const Isometry kTurned =
    make_isometry(Eigen::Quaterniond(0.3, 0.8, -0.2, 0.4).normalized(), Vec3(20.0, -5.0, 3.0));

class JawAxesOf : public ::testing::TestWithParam<std::pair<double, double>> {};

TEST_P(JawAxesOf, FollowTheJawInAnyOrientation) {
  const auto [half_length_mm, bend] = GetParam();
  const JawAxes axes = jaw_axes(arch(half_length_mm, bend, kTurned));
  // The mean normal of the arch is occlusal but for the few steps of the sampling.
  EXPECT_GT(axes.occlusal.dot(kTurned.linear().col(2)), 0.99);
  EXPECT_GT(axes.buccal.dot(kTurned.linear().col(1)), 0.99);
  EXPECT_NEAR(axes.occlusal.dot(axes.buccal), 0.0, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Jaws, JawAxesOf,
                         ::testing::Values(std::pair(30.0, 0.8),    // a whole arch
                                           std::pair(15.0, 0.2)));  // a bent quadrant

TEST(StandardViews, LookFromTheRightSide) {
  const JawAxes axes = jaw_axes(arch(30.0, 0.8, kTurned));
  const auto towards_eye = [&](StandardView view) -> Vec3 {
    return orientation(axes, view) * Vec3::UnitZ();
  };
  EXPECT_NEAR(towards_eye(StandardView::kOcclusal).dot(axes.occlusal), 1.0, 1e-12);
  EXPECT_GT(towards_eye(StandardView::kBuccal).dot(axes.buccal), 0.9);
  EXPECT_LT(towards_eye(StandardView::kLingual).dot(axes.buccal), -0.9);
  for (const StandardView view : {StandardView::kBuccal, StandardView::kLingual}) {
    EXPECT_GT((orientation(axes, view) * Vec3::UnitY()).dot(axes.occlusal), 0.9)
        << "the chewing surface is up";
  }
}

TEST(StandardViews, TheBoxFollowsTheJawInAnyOrientation) {
  const auto volume_of = [](const Isometry& T_world_arch) {
    const std::vector<Vec3> corners = jaw_axes(arch(30.0, 0.8, T_world_arch)).corners_mm;
    EXPECT_EQ(corners.size(), 8U);
    return (corners[7] - corners[0]).norm();
  };
  EXPECT_NEAR(volume_of(kTurned), volume_of(Isometry::Identity()), 0.01);
}

TEST(StandardViews, NothingScannedHasNoBox) {
  EXPECT_TRUE(jaw_axes(SurfelModel{}).corners_mm.empty());
}

}  // namespace
}  // namespace flytri::ui
