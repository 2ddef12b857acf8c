#include "core/review/undercut.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "core/base/random.h"
#include "core/geometry/mesh_normals.h"
#include "core/review/insertion_axis.h"
#include "tests/support/revolved.h"

namespace flytri::review {
namespace {

using ::testing::AllOf;
using ::testing::Gt;
using ::testing::HasSubstr;
using ::testing::Lt;

constexpr double kPi = std::numbers::pi;
constexpr double kDegree_rad = kPi / 180.0;

Undercut undercut_of(const TriangleMesh& mesh, const Vec3& axis) {
  auto undercut = find_undercut(mesh, axis, {}, Workers(2));
  EXPECT_TRUE(undercut) << undercut.error().message;
  return undercut.value_or(Undercut{});
}

/// A circle as a profile, clockwise from its top.
std::vector<Vec2> circle_profile(const Vec2& center_mm, double radius_mm, double turn, int steps) {
  std::vector<Vec2> profile;
  for (int i = 0; i <= steps; ++i)
    profile.push_back(center_mm +
                      radius_mm * Vec2(std::sin(turn * i / steps), std::cos(turn * i / steps)));
  return profile;
}

TriangleMesh ball_for_undercut(double radius_mm) {
  std::vector<Vec2> profile = circle_profile(Vec2::Zero(), radius_mm, kPi, 60);
  profile.front().x() = profile.back().x() = 0.0;
  return testing::revolved(profile, 120);
}

/// A cylinder on a base, with large triangles.
TriangleMesh cylinder_on_base(double radius_mm, double height_mm, double base_mm) {
  const std::vector<Vec2> profile = {
      {0.0, height_mm}, {radius_mm, height_mm}, {radius_mm, 0.0}, {base_mm, 0.0}};
  return testing::revolved(testing::divided(profile, 0.8), 240);
}

/// Compares with the true area, and prints how far off it is.
void expect_area(const Undercut& undercut, double truth_mm2, double share,
                 const std::string& what) {
  const double off = undercut.area_mm2.value / truth_mm2 - 1.0;
  fmt::print("{}: {:.2f} of {:.2f} mm², {:+.2f} %\n", what, undercut.area_mm2.value, truth_mm2,
             100.0 * off);
  EXPECT_LT(std::abs(off), share) << what;
}

Vec3 tilted_axis(double degrees) {
  const double tilt = degrees * kDegree_rad;
  return {std::sin(tilt) * std::cos(0.3), std::sin(tilt) * std::sin(0.3), std::cos(tilt)};
}

TEST(Undercut, OfABallIsItsLowerHalf) {
  const TriangleMesh mesh = ball_for_undercut(4.0);
  for (const Vec3& axis : {Vec3(0, 0, 1), Vec3(1, 2, -0.5), Vec3(-3, 0.1, 0.2)}) {
    const Undercut undercut = undercut_of(mesh, axis);
    expect_area(undercut, 2.0 * kPi * 16.0, 0.02, "ball");
    EXPECT_NEAR(undercut.surface_mm2 / (4.0 * kPi * 16.0), 1.0, 0.01);
    EXPECT_NEAR(undercut.deepest_mm, 2.0, 1e-6) << "4 mm, but not deeper than asked";
  }
}

TEST(Undercut, OfATorusIsItsLowerHalf) {
  const double ring_mm = 4.0, tube_mm = 1.2;
  const TriangleMesh mesh =
      testing::revolved(circle_profile({ring_mm, 0.0}, tube_mm, 2.0 * kPi, 60), 160);
  const Undercut undercut = undercut_of(mesh, Vec3::UnitZ());
  expect_area(undercut, 2.0 * kPi * kPi * ring_mm * tube_mm, 0.02, "torus");
  EXPECT_NEAR(undercut.deepest_mm, tube_mm, 0.05);
}

TEST(Undercut, OfAReversedTaperIsItsWallAndWhatItCovers) {
  // The base below the wall faces the viewer, and is hidden all the same.
  const double top_mm = 3.5, neck_mm = 2.9, height_mm = 4.0;
  const TriangleMesh mesh = testing::revolved(
      testing::divided({{0.0, height_mm}, {top_mm, height_mm}, {neck_mm, 0.0}, {6.0, 0.0}}, 0.9),
      120);
  const Undercut undercut = undercut_of(mesh, Vec3::UnitZ());
  const double wall_mm2 = kPi * (top_mm + neck_mm) * std::hypot(top_mm - neck_mm, height_mm);
  const double covered_mm2 = kPi * (top_mm * top_mm - neck_mm * neck_mm);
  expect_area(undercut, wall_mm2 + covered_mm2, 0.02, "reversed taper on a base");
  EXPECT_NEAR(undercut.deepest_mm, top_mm - neck_mm, 0.12)
      << "in the middle of the lowest triangles";
  // Half of the wall is more than half as deep.
  const double deep_mm2 = undercut.area_deeper_mm2(mesh, 0.3);
  EXPECT_THAT(deep_mm2, AllOf(Gt(0.4 * wall_mm2), Lt(0.6 * wall_mm2 + covered_mm2)));
}

TEST(Undercut, OfATiltedCylinderIsItsBackAndItsShadow) {
  const double radius_mm = 2.0, height_mm = 3.0;
  const TriangleMesh mesh = cylinder_on_base(radius_mm, height_mm, 9.0);
  for (const double degrees : {10.0, 20.0, 40.0}) {
    const Undercut undercut = undercut_of(mesh, 5.0 * tilted_axis(degrees));
    const double shadow_mm2 = 2.0 * radius_mm * height_mm * std::tan(degrees * kDegree_rad);
    const double truth_mm2 = kPi * radius_mm * height_mm + shadow_mm2;
    expect_area(undercut, truth_mm2, 0.03, fmt::format("cylinder tilted by {} degrees", degrees));
  }
}

TEST(Undercut, OfAWallAlongTheAxisIsNone) {
  const TriangleMesh mesh = cylinder_on_base(2.0, 3.0, 4.0);
  const Undercut undercut = undercut_of(mesh, Vec3::UnitZ());
  EXPECT_LT(undercut.area_mm2.value, 0.01);
  EXPECT_EQ(undercut.area_mm2.uncertainty, 0.0) << "a perfect shape has no noise";
}

TEST(Undercut, UncertaintyCoversWhatNoiseDoes) {
  constexpr double kNoise_mm = 0.01;
  const double top_mm = 3.2, neck_mm = 2.9, height_mm = 4.0;
  TriangleMesh mesh = testing::revolved(
      testing::divided({{0.0, height_mm}, {top_mm, height_mm}, {neck_mm, 0.0}}, 0.15), 140);
  Random random(5);
  for (SurfacePoint& vertex : mesh.vertices) {
    vertex.sigma_mm = static_cast<float>(kNoise_mm);
    vertex.position_mm += static_cast<float>(kNoise_mm * random.normal()) * vertex.normal;
  }
  compute_vertex_normals(mesh);
  const Undercut undercut = undercut_of(mesh, Vec3::UnitZ());
  const double truth_mm2 = kPi * (top_mm + neck_mm) * std::hypot(top_mm - neck_mm, height_mm);
  expect_area(undercut, truth_mm2, 0.05, "reversed taper with noise");
  fmt::print("uncertainty {:.2f} mm²\n", undercut.area_mm2.uncertainty);
  EXPECT_LT(std::abs(undercut.area_mm2.value - truth_mm2), 3.0 * undercut.area_mm2.uncertainty);
  EXPECT_LT(undercut.area_mm2.uncertainty, 0.1 * truth_mm2);
  mesh.vertices[7].sigma_mm = std::numeric_limits<float>::infinity();
  EXPECT_EQ(undercut_of(mesh, Vec3::UnitZ()).area_mm2.uncertainty,
            std::numeric_limits<double>::infinity());
}

TEST(Undercut, IsTheSameForAnyNumberOfThreads) {
  const TriangleMesh mesh = cylinder_on_base(2.0, 3.0, 5.0);
  const auto one = find_undercut(mesh, tilted_axis(17.0), {}, Workers(1));
  const auto three = find_undercut(mesh, tilted_axis(17.0), {}, Workers(3));
  ASSERT_TRUE(one && three);
  EXPECT_EQ(one->hidden_share, three->hidden_share);
  EXPECT_EQ(one->depth_mm, three->depth_mm);
}

TEST(Undercut, OfAPartDependsOnThatPartAlone) {
  const TriangleMesh mesh = cylinder_on_base(2.0, 3.0, 9.0);
  const auto part = part_around(mesh, {0.0, 0.0, 0.0}, 3.0);
  ASSERT_TRUE(part);
  EXPECT_LT(part->triangles.size(), mesh.triangles.size());
  EXPECT_LT(undercut_of(*part, tilted_axis(30.0)).surface_mm2, 70.0);
  const auto none = part_around(mesh, {0.0, 0.0, 90.0}, 3.0);
  ASSERT_FALSE(none);
  EXPECT_THAT(none.error().message, HasSubstr("no surface within 3 mm"));
}

TEST(Undercut, RefusesBadInput) {
  const TriangleMesh mesh = cylinder_on_base(2.0, 3.0, 4.0);
  EXPECT_EQ(find_undercut(mesh, Vec3::Zero(), {}, Workers(1)).error().code, ErrorCode::kBadOption);
  EXPECT_EQ(find_undercut({}, Vec3::UnitZ(), {}, Workers(1)).error().code,
            ErrorCode::kInsufficient);
  UndercutOptions options;
  options.part_mm = 0.0;
  EXPECT_EQ(find_undercut(mesh, Vec3::UnitZ(), options, Workers(1)).error().code,
            ErrorCode::kBadOption);
}

double off_degrees(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b)) / kDegree_rad;
}

TEST(InsertionAxis, OfACylinderIsItsOwn) {
  const TriangleMesh mesh =
      testing::revolved(testing::divided({{0.0, 4.0}, {2.5, 4.0}, {2.5, 0.0}}, 0.5), 90);
  const auto found = find_insertion_axis(mesh, tilted_axis(12.0), {}, Workers(2));
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_LT(off_degrees(found->axis, Vec3::UnitZ()), 1.0);
  EXPECT_LT(found->equal_within_rad, 3.0 * kDegree_rad);
}

TEST(InsertionAxis, OfATaperedStumpIsInTheMiddleOfAllThatFit) {
  // Walls lean by 6 degrees, so all axes up to that fit.
  const double lean = std::tan(6.0 * kDegree_rad);
  const TriangleMesh mesh = testing::revolved(
      testing::divided({{0.0, 4.0}, {2.5, 4.0}, {2.5 + 4.0 * lean, 0.0}}, 0.5), 90);
  const auto found = find_insertion_axis(mesh, tilted_axis(15.0), {}, Workers(2));
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_LT(off_degrees(found->axis, Vec3::UnitZ()), 2.0);
  EXPECT_EQ(found->undercut_mm2, 0.0);
  EXPECT_THAT(found->equal_within_rad / kDegree_rad, AllOf(Gt(3.0), Lt(8.0)));
}

TEST(InsertionAxis, OfAClosedSurfaceNeedsAStart) {
  const TriangleMesh mesh = ball_for_undercut(2.0);
  EXPECT_EQ(mean_normal(mesh), Vec3(Vec3::Zero()));
  const auto found = find_insertion_axis(mesh, mean_normal(mesh), {}, Workers(1));
  ASSERT_FALSE(found);
  EXPECT_THAT(found.error().message, HasSubstr("give an axis"));
}

}  // namespace
}  // namespace flytri::review
