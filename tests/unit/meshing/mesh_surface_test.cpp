#include "core/meshing/mesh_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>

#include "core/base/random.h"

namespace flytri::meshing {
namespace {

/// Evenly spaced points on the upper half of a sphere, without those that `leave_out` selects.
PointCloud half_sphere(double radius_mm, double spacing_mm, double noise_mm,
                       const std::function<bool(const Vec3&)>& leave_out) {
  PointCloud points;
  Random random(1);
  const auto count = static_cast<int>(2 * M_PI * radius_mm * radius_mm / (spacing_mm * spacing_mm));
  for (int i = 0; i < count; ++i) {
    // Fibonacci lattice: even spacing without a grid.
    const double z = 1.0 - (i + 0.5) / count;
    const double r = std::sqrt(1.0 - z * z);
    const double angle = i * M_PI * (3.0 - std::sqrt(5.0));
    const Vec3 n(r * std::cos(angle), r * std::sin(angle), z);
    if (leave_out(n)) continue;
    SurfacePoint point;
    point.position_mm = ((radius_mm + noise_mm * random.normal()) * n).cast<float>();
    point.normal = n.cast<float>();
    points.push_back(point);
  }
  return points;
}

constexpr double kRadiusMm = 4.0;
constexpr double kSpacingMm = 0.1;
bool none(const Vec3& /*n*/) { return false; }

SurfaceMesh mesh_of(const PointCloud& points, int threads = 2) {
  auto mesh = mesh_surface(points, {}, Workers(threads));
  EXPECT_TRUE(mesh.has_value());
  return *mesh;
}

TEST(MeshSurface, VerticesLieOnTheSphereAndTrianglesFaceOutwards) {
  const SurfaceMesh surface = mesh_of(half_sphere(kRadiusMm, kSpacingMm, 0.0, none));
  for (const SurfacePoint& vertex : surface.mesh.vertices) {
    // Tangent planes are outside the sphere by s^2 / 2r, for s = 1 spacing 1.25 µm; more at the
    // border.
    EXPECT_NEAR(vertex.position_mm.norm(), kRadiusMm, 0.006);
  }
  for (const Triangle& t : surface.mesh.triangles) {
    const auto& v = surface.mesh.vertices;
    const Vec3f cross = (v[t[1]].position_mm - v[t[0]].position_mm)
                            .cross(v[t[2]].position_mm - v[t[0]].position_mm);
    EXPECT_GT(cross.dot(v[t[0]].position_mm), 0.0F);
  }
}

TEST(MeshSurface, AveragesNoise) {
  const SurfaceMesh surface = mesh_of(half_sphere(kRadiusMm, kSpacingMm, 0.01, none));
  double sum = 0.0;
  for (const SurfacePoint& vertex : surface.mesh.vertices) {
    sum += std::pow(vertex.position_mm.norm() - kRadiusMm, 2);
  }
  EXPECT_LT(std::sqrt(sum / static_cast<double>(surface.mesh.vertices.size())), 0.008);
}

TEST(MeshSurface, IsAnOrientedManifold) {
  const SurfaceMesh surface = mesh_of(half_sphere(kRadiusMm, kSpacingMm, 0.01, none));
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> directed;
  for (const Triangle& t : surface.mesh.triangles) {
    for (int k = 0; k < 3; ++k) ++directed[{t[k], t[(k + 1) % 3]}];
  }
  for (const auto& [edge, count] : directed) EXPECT_EQ(count, 1);
}

TEST(MeshSurface, KeepsAHoleOpenAndMeasuresIt) {
  constexpr double kHoleRad = 0.3;
  const auto in_hole = [](const Vec3& n) { return std::acos(n.z()) < kHoleRad; };
  const SurfaceMesh surface = mesh_of(half_sphere(kRadiusMm, kSpacingMm, 0.0, in_hole));
  ASSERT_EQ(surface.boundaries.size(), 2U);
  EXPECT_TRUE(surface.boundaries[0].is_outer);
  const BoundaryLoop& hole = surface.boundaries[1];
  EXPECT_FALSE(hole.is_outer);
  const double radius_mm = kRadiusMm * std::sin(kHoleRad);
  // The border follows the grid to about one spacing of the mesh.
  EXPECT_NEAR(std::sqrt(hole.area_mm2 / M_PI), radius_mm, 0.2);
  EXPECT_NEAR(hole.width_mm, 2.0 * radius_mm, 0.4);
  EXPECT_GT(hole.normal.z(), 0.99F);
  EXPECT_NEAR(hole.center_mm.head<2>().norm(), 0.0, 0.1);
}

TEST(MeshSurface, ClosesASlotNarrowerThanTheLineSpacing) {
  const auto in_slot = [](const Vec3& n) { return std::abs(n.x()) * kRadiusMm < 0.12; };
  const SurfaceMesh surface = mesh_of(half_sphere(kRadiusMm, kSpacingMm, 0.0, in_slot));
  EXPECT_EQ(surface.boundaries.size(), 1U);
}

TEST(MeshSurface, ASingleLineOfPointsIsNotASurface) {
  PointCloud points = half_sphere(kRadiusMm, kSpacingMm, 0.0, none);
  for (int i = 0; i < 100; ++i) {
    SurfacePoint point;
    point.position_mm = Vec3f(10.0F + 0.05F * static_cast<float>(i), 0, 0);
    points.push_back(point);
  }
  for (const SurfacePoint& vertex : mesh_of(points).mesh.vertices) {
    EXPECT_LT(vertex.position_mm.x(), 6.0F);
  }
}

TEST(MeshSurface, OneThreadAndManyGiveTheSameBits) {
  const PointCloud points = half_sphere(kRadiusMm, kSpacingMm, 0.01, none);
  const SurfaceMesh one = mesh_of(points, 1);
  const SurfaceMesh many = mesh_of(points, 4);
  EXPECT_EQ(one.mesh.triangles, many.mesh.triangles);
  ASSERT_EQ(one.mesh.vertices.size(), many.mesh.vertices.size());
  for (std::size_t i = 0; i < one.mesh.vertices.size(); ++i) {
    EXPECT_EQ(one.mesh.vertices[i].position_mm, many.mesh.vertices[i].position_mm);
  }
}

TEST(MeshSurface, TooFewPointsAreAnError) {
  const auto mesh = mesh_surface(PointCloud(3), {}, Workers(1));
  ASSERT_FALSE(mesh.has_value());
  EXPECT_EQ(mesh.error().code, ErrorCode::kInsufficient);
}

}  // namespace
}  // namespace flytri::meshing
