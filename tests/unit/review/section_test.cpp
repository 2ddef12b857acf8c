#include "core/review/section.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "core/geometry/mesh_normals.h"
#include "tests/support/revolved.h"
#include "tests/support/sample_meshes.h"

namespace flytri::review {
namespace {

using ::testing::HasSubstr;

constexpr double kHalfTurn = std::numbers::pi;

TriangleMesh ball(double radius_mm, int rows) {
  std::vector<Vec2> profile = {{0.0, radius_mm}};
  for (int i = 1; i < rows; ++i)
    profile.push_back(radius_mm *
                      Vec2(std::sin(kHalfTurn * i / rows), std::cos(kHalfTurn * i / rows)));
  profile.push_back({0.0, -radius_mm});
  return testing::revolved(profile, 2 * rows);
}

/// Corners at 1 mm from the origin on the axes.
TriangleMesh octahedron() { return testing::revolved({{0.0, 1.0}, {1.0, 0.0}, {0.0, -1.0}}, 4); }

double least_step_mm(const Polyline& line) {
  double least_mm = 1e9;
  for (std::size_t i = 0; i + 1 < line.points.size(); ++i)
    least_mm =
        std::min(least_mm, (line.points[i + 1].position_mm - line.points[i].position_mm).norm());
  if (line.is_closed)
    least_mm = std::min(least_mm,
                        (line.points.front().position_mm - line.points.back().position_mm).norm());
  return least_mm;
}

/// Twice the signed area as seen against z, mm^2.
double signed_area_mm2(const Polyline& line) {
  double sum = 0.0;
  for (std::size_t i = 0; i < line.points.size(); ++i) {
    const Vec3& a = line.points[i].position_mm;
    const Vec3& b = line.points[(i + 1) % line.points.size()].position_mm;
    sum += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * sum;
}

TEST(Section, OfABallIsACircle) {
  const auto section = section_of(ball(4.0, 100), {{0.0, 0.0, 1.3}, {0.0, 0.0, 2.0}});
  ASSERT_TRUE(section) << section.error().message;
  ASSERT_EQ(section->size(), 1U);
  const Polyline& circle = section->front();
  EXPECT_TRUE(circle.is_closed);
  const double radius_mm = std::sqrt(16.0 - 1.69);
  for (const MeasuredPoint& point : circle.points) {
    EXPECT_NEAR(point.position_mm.z(), 1.3, 1e-6);
    EXPECT_NEAR(point.position_mm.head<2>().norm(), radius_mm, 0.003);
  }
  EXPECT_NEAR(length_mm(circle).value, 2.0 * kHalfTurn * radius_mm, 0.02);
  EXPECT_GT(least_step_mm(circle), 1e-3);
  EXPECT_NEAR(signed_area_mm2(circle), kHalfTurn * radius_mm * radius_mm, 0.05)
      << "counterclockwise";
}

TEST(Section, ThroughVerticesAndAlongEdgesIsWholeAndHasNothingTwice) {
  for (const Vec3& normal : {Vec3(0, 0, 1), Vec3(0, 0, -1), Vec3(1, 0, 0)}) {
    const auto section = section_of(octahedron(), {Vec3::Zero(), normal});
    ASSERT_TRUE(section) << section.error().message;
    ASSERT_EQ(section->size(), 1U);
    EXPECT_TRUE(section->front().is_closed);
    EXPECT_EQ(section->front().points.size(), 4U);
    EXPECT_NEAR(length_mm(section->front()).value, 4.0 * std::sqrt(2.0), 1e-6);
    EXPECT_GT(least_step_mm(section->front()), 1.0);
  }
  // Through two corners, and across the edges between.
  const auto tilted = section_of(octahedron(), {Vec3::Zero(), Vec3(1, 1, 0)});
  ASSERT_TRUE(tilted);
  ASSERT_EQ(tilted->size(), 1U);
  EXPECT_EQ(tilted->front().points.size(), 4U);
}

TEST(Section, OfSurfaceThatOnlyTouchesThePlaneIsNone) {
  const auto at_corner = section_of(octahedron(), {{0.0, 0.0, 1.0}, Vec3::UnitZ()});
  ASSERT_FALSE(at_corner);
  EXPECT_EQ(at_corner.error().code, ErrorCode::kInsufficient);
  // A roof whose ridge lies in the plane.
  const TriangleMesh roof = height_field({2.0, 0.5}, [](double x, double) { return -std::abs(x); });
  EXPECT_FALSE(section_of(roof, {Vec3::Zero(), Vec3::UnitZ()}));
  EXPECT_FALSE(section_of(roof, {Vec3::Zero(), -Vec3::UnitZ()}));
}

TEST(Section, OfAFlatTopInThePlaneIsItsBorder) {
  const TriangleMesh table =
      testing::revolved(testing::divided({{0.0, 1.0}, {2.0, 1.0}, {3.0, 0.0}}, 0.5), 40);
  const auto section = section_of(table, {{0.0, 0.0, 1.0}, Vec3::UnitZ()});
  ASSERT_TRUE(section) << section.error().message;
  ASSERT_EQ(section->size(), 1U);
  EXPECT_EQ(section->front().points.size(), 40U);
  for (const MeasuredPoint& point : section->front().points)
    EXPECT_NEAR(point.position_mm.head<2>().norm(), 2.0, 1e-6);
}

TEST(Section, OfAnOpenSurfaceRunsFromBorderToBorder) {
  // Also along a line of edges, and through every vertex on it.
  const TriangleMesh wave =
      height_field({2.0, 0.25}, [](double x, double y) { return 0.2 * std::sin(x) + 0.1 * y; });
  for (const double at_mm : {0.0, 0.1}) {
    const auto section = section_of(wave, {{0.0, at_mm, 0.0}, Vec3::UnitY()});
    ASSERT_TRUE(section);
    ASSERT_EQ(section->size(), 1U);
    const Polyline& line = section->front();
    EXPECT_FALSE(line.is_closed);
    EXPECT_NEAR(std::abs(line.points.front().position_mm.x()), 2.0, 1e-6);
    EXPECT_NEAR(line.points.front().position_mm.x(), -line.points.back().position_mm.x(), 1e-6);
    EXPECT_GT(least_step_mm(line), 1e-2);
    const double forward = line.points.back().position_mm.x() > 0.0 ? 1.0 : -1.0;
    for (std::size_t i = 1; i < line.points.size(); ++i)
      EXPECT_GT(forward * (line.points[i].position_mm.x() - line.points[i - 1].position_mm.x()),
                0.0);
  }
}

TEST(Section, MeasuresAlongAnOutlineTheShorterWay) {
  const auto section = section_of(ball(4.0, 200), {Vec3(0.0, 0.0, 0.01), Vec3::UnitZ()});
  ASSERT_TRUE(section);
  for (const double turn : {0.5, 2.0, 4.0, 6.0}) {
    const SectionPlace a = nearest_place(*section, Vec3(5.0, 0.3, 0.0));
    const double begin = std::atan2(0.3, 5.0);
    const SectionPlace b =
        nearest_place(*section, 7.0 * Vec3(std::cos(begin + turn), std::sin(begin + turn), 0.1));
    const auto part = part_between(*section, a, b);
    ASSERT_TRUE(part);
    EXPECT_FALSE(part->is_closed);
    EXPECT_NEAR(length_mm(*part).value, 4.0 * std::min(turn, 2.0 * kHalfTurn - turn), 0.02);
    EXPECT_NEAR(distance_mm(a.point, b.point).value, 8.0 * std::abs(std::sin(0.5 * turn)), 0.01);
  }
}

TEST(Section, NoWayLeadsAlongTwoOutlines) {
  const TriangleMesh ring = [] {
    std::vector<Vec2> profile;
    for (int i = 0; i <= 40; ++i)
      profile.emplace_back(3.0 + std::sin(2.0 * kHalfTurn * i / 40),
                           std::cos(2.0 * kHalfTurn * i / 40));
    return testing::revolved(profile, 80);
  }();
  const auto section = section_of(ring, {Vec3(0.0, 0.0, 0.01), Vec3::UnitZ()});
  ASSERT_TRUE(section);
  ASSERT_EQ(section->size(), 2U);
  EXPECT_GT(signed_area_mm2((*section)[0]), 0.0) << "the outer border";
  EXPECT_LT(signed_area_mm2((*section)[1]), 0.0) << "the inner one runs the other way";
  const auto part = part_between(*section, nearest_place(*section, {5.0, 0.0, 0.0}),
                                 nearest_place(*section, {1.0, 0.0, 0.0}));
  ASSERT_FALSE(part);
  EXPECT_THAT(part.error().message, HasSubstr("different outlines"));
}

TEST(Section, UncertaintyIsThatAcrossTheOutline) {
  TriangleMesh plane = height_field({1.0, 0.5}, [](double x, double) { return x; });
  for (SurfacePoint& vertex : plane.vertices) vertex.sigma_mm = 0.01F;
  const auto section = section_of(plane, {{0.0, 0.0, 0.1}, Vec3::UnitZ()});
  ASSERT_TRUE(section);
  // The surface lies at 45 degrees to the plane.
  for (const MeasuredPoint& point : section->front().points)
    EXPECT_NEAR(point.sigma_mm, 0.01 * std::sqrt(2.0), 1e-6);
  EXPECT_NEAR(length_mm(section->front()).uncertainty, 0.01 * 2.0, 1e-4) << "of its two ends";
}

TEST(Section, RefusesAPlaneWithoutADirection) {
  const auto section = section_of(octahedron(), {Vec3::Zero(), Vec3::Zero()});
  ASSERT_FALSE(section);
  EXPECT_EQ(section.error().code, ErrorCode::kBadOption);
}

}  // namespace
}  // namespace flytri::review
