#include "core/meshing/mesh_quality.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace flytri::meshing {
namespace {

TriangleMesh mesh_of(const std::vector<Vec3f>& places, const std::vector<Triangle>& triangles) {
  TriangleMesh mesh;
  for (const Vec3f& p : places) mesh.vertices.emplace_back().position_mm = p;
  mesh.triangles = triangles;
  return mesh;
}

const std::vector<Vec3f> kSquare = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0},
                                    {0, 1, 0}, {2, 2, 0}, {2, 1, 0}};

TEST(MeshQuality, CountsAndMeasures) {
  const MeshQuality quality = mesh_quality(mesh_of(kSquare, {{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(quality.triangles, 2U);
  EXPECT_EQ(quality.vertices, 4U);
  EXPECT_EQ(quality.boundaries, 1U);
  EXPECT_EQ(quality.components, 1U);
  EXPECT_TRUE(quality.is_manifold);
  EXPECT_TRUE(quality.is_oriented);
  EXPECT_NEAR(quality.least_angle_rad, std::numbers::pi / 4.0, 1e-6);
  EXPECT_NEAR(quality.worst_aspect, 0.5 * (1.0 + std::sqrt(2.0)), 1e-6);
  EXPECT_EQ(quality.sliver_share, 0.0);
  EXPECT_EQ(quality.turned, 0U);
}

TEST(MeshQuality, FindsTrianglesThatAreTurned) {
  const MeshQuality quality = mesh_quality(mesh_of(kSquare, {{0, 1, 2}, {0, 3, 2}}));
  EXPECT_FALSE(quality.is_oriented);
  EXPECT_EQ(quality.turned, 1U);
}

TEST(MeshQuality, FindsThreeTrianglesAtAnEdge) {
  EXPECT_FALSE(mesh_quality(mesh_of(kSquare, {{0, 1, 2}, {0, 2, 3}, {2, 0, 5}})).is_manifold);
}

TEST(MeshQuality, FindsTwoFansAtAVertex) {
  const MeshQuality quality = mesh_quality(mesh_of(kSquare, {{0, 1, 2}, {2, 5, 4}}));
  EXPECT_FALSE(quality.is_manifold);
  EXPECT_TRUE(quality.is_oriented);
}

TEST(MeshQuality, FindsSliversAndTrianglesWithoutArea) {
  const std::vector<Vec3f> thin = {{0, 0, 0}, {1, 0, 0}, {0.5F, 0.05F, 0}, {2, 0, 0}};
  EXPECT_EQ(mesh_quality(mesh_of(thin, {{0, 1, 2}})).sliver_share, 1.0);
  EXPECT_TRUE(std::isinf(mesh_quality(mesh_of(thin, {{0, 1, 3}})).worst_aspect));
}

}  // namespace
}  // namespace flytri::meshing
