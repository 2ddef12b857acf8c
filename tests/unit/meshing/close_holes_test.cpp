#include "core/meshing/close_holes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/meshing/mesh_quality.h"
#include "core/meshing/mesh_topology.h"
#include "tests/support/sample_meshes.h"

namespace flytri::meshing {
namespace {

constexpr double kBallRadius_mm = 5.0;  ///< as a molar's cusps are round

/// The cap of a sphere, with a hole in its middle.
TriangleMesh punched_cap(float hole_mm) {
  TriangleMesh cap = height_field({.half_width_mm = 2.5, .step_mm = 0.1}, [](double x, double y) {
    return kBallRadius_mm - std::sqrt(kBallRadius_mm * kBallRadius_mm - x * x - y * y);
  });
  std::erase_if(cap.triangles, [&](const Triangle& t) {
    return cap.vertices[t[0]].position_mm.head<2>().norm() < 0.5F * hole_mm;
  });
  drop_unused_vertices(cap);
  return cap;
}

double off_sphere_mm(const SurfacePoint& p) {
  return (p.position_mm.cast<double>() - Vec3(0.0, 0.0, kBallRadius_mm)).norm() - kBallRadius_mm;
}

TEST(CloseHoles, FollowsTheCurvatureAround) {
  TriangleMesh cap = punched_cap(2.0F);
  const std::size_t measured = cap.vertices.size();
  EXPECT_EQ(close_holes(cap, 3.0), 1U);
  // A flat lid would lie 0.1 mm below; this one lies 0.0113 mm below at most.
  ASSERT_GT(cap.vertices.size(), measured + 100);
  for (std::size_t v = measured; v < cap.vertices.size(); ++v) {
    EXPECT_NEAR(off_sphere_mm(cap.vertices[v]), 0.0, 0.012);
    const Vec3f outwards =
        (cap.vertices[v].position_mm - Vec3f(0.0F, 0.0F, static_cast<float>(kBallRadius_mm)))
            .normalized();
    EXPECT_GT(cap.vertices[v].normal.dot(outwards), 0.99F);
  }
}

TEST(CloseHoles, MarksWhatWasNotMeasured) {
  TriangleMesh cap = punched_cap(2.0F);
  for (SurfacePoint& p : cap.vertices) {
    p.color = {10, 20, 30};
    p.sigma_mm = 0.01F;
  }
  const TriangleMesh before = cap;
  close_holes(cap, 3.0);
  for (std::size_t v = 0; v < cap.vertices.size(); ++v) {
    EXPECT_EQ(std::isinf(cap.vertices[v].sigma_mm), v >= before.vertices.size());
    EXPECT_EQ(cap.vertices[v].color, (Rgb{10, 20, 30}));
    if (v >= before.vertices.size()) continue;
    EXPECT_EQ(cap.vertices[v].position_mm, before.vertices[v].position_mm);
  }
  EXPECT_EQ(mesh_quality(cap).not_measured, cap.vertices.size() - before.vertices.size());
}

TEST(CloseHoles, LeavesAManifoldWithoutSlivers) {
  TriangleMesh cap = punched_cap(2.0F);
  close_holes(cap, 3.0);
  const MeshQuality quality = mesh_quality(cap);
  EXPECT_TRUE(quality.is_manifold);
  EXPECT_TRUE(quality.is_oriented);
  EXPECT_EQ(quality.boundaries, 1U);
  EXPECT_EQ(quality.turned, 0U);
  EXPECT_LT(quality.sliver_share, 0.001);
}

TEST(CloseHoles, LeavesWideHolesAndBordersOpen) {
  TriangleMesh cap = punched_cap(2.0F);
  const std::size_t triangles = cap.triangles.size();
  EXPECT_EQ(close_holes(cap, 1.0), 0U);
  EXPECT_EQ(close_holes(cap, 0.0), 0U);
  EXPECT_EQ(cap.triangles.size(), triangles);
  EXPECT_EQ(close_holes(cap, 100.0), 1U) << "the border is not a hole";
}

TEST(CloseHoles, ClosesAHoleOfOneTriangle) {
  TriangleMesh cap = punched_cap(0.0F);
  cap.triangles.erase(cap.triangles.begin() + 1250);
  EXPECT_EQ(close_holes(cap, 1.0), 1U);
  EXPECT_EQ(mesh_quality(cap).boundaries, 1U);
}

}  // namespace
}  // namespace flytri::meshing
