#include "core/meshing/simplify.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/evaluation/surface_error.h"
#include "core/geometry/mesh_normals.h"
#include "core/meshing/mesh_quality.h"
#include "core/meshing/mesh_topology.h"
#include "tests/support/sample_meshes.h"

namespace flytri::meshing {
namespace {

/// A surface with a sharp ridge on a gentle wave, 0.1 mm fine.
TriangleMesh ridge() {
  return height_field({.half_width_mm = 4.0, .step_mm = 0.1}, [](double x, double y) {
    return 0.3 * std::sin(0.8 * x) - 0.5 * std::exp(-std::abs(y) / 0.4);
  });
}

TriangleMesh with(const TriangleMesh& full, const Simplified& simplified) {
  TriangleMesh mesh{full.vertices, simplified.triangles};
  drop_unused_vertices(mesh);
  return mesh;
}

/// A mesh whose vertices are samples of another one's whole surface: corners, middles of triangles
/// and of edges.
TriangleMesh sampled(const TriangleMesh& mesh) {
  TriangleMesh samples = mesh;
  const auto add = [&](const Vec3f& p) { samples.vertices.emplace_back().position_mm = p; };
  for (const Triangle& t : mesh.triangles) {
    const Vec3f &a = mesh.vertices[t[0]].position_mm, &b = mesh.vertices[t[1]].position_mm,
                &c = mesh.vertices[t[2]].position_mm;
    for (const Vec3f& p : {Vec3f((a + b + c) / 3.0F), Vec3f(0.5F * (a + b)), Vec3f(0.5F * (b + c)),
                           Vec3f(0.5F * (c + a))})
      add(p);
  }
  return samples;
}

evaluation::DistanceStatistics distance(const TriangleMesh& from, const TriangleMesh& to) {
  return evaluation::surface_error(sampled(from), to, {}, {}, Workers(1))->distance;
}

Simplified simplified(const TriangleMesh& mesh, const SimplifyOptions& options = {}) {
  const Result<Simplified> result = simplify(mesh, options);
  EXPECT_TRUE(result.has_value());
  return result.value_or(Simplified{});
}

TEST(Simplify, KeepsTheBoundInBothDirections) {
  const TriangleMesh full = ridge();
  const TriangleMesh light = with(full, simplified(full));
  EXPECT_LT(light.triangles.size(), full.triangles.size() / 4);
  for (const auto& added : {distance(light, full), distance(full, light)}) {
    EXPECT_LE(added.rms_mm, 0.002);
    EXPECT_LE(added.max_mm, 0.010);
  }
}

TEST(Simplify, IsFineAtRidgesAndCoarseWhereTheSurfaceIsSmooth) {
  const TriangleMesh full = ridge();
  const TriangleMesh light = with(full, simplified(full));
  const auto near_ridge = [](const TriangleMesh& mesh) {
    return static_cast<double>(std::count_if(
               mesh.vertices.begin(), mesh.vertices.end(),
               [](const SurfacePoint& p) { return std::abs(p.position_mm.y()) < 0.5F; })) /
           static_cast<double>(mesh.vertices.size());
  };
  EXPECT_GT(near_ridge(light), 2.0 * near_ridge(full));
}

TEST(Simplify, KeepsVerticesWithTheirData) {
  TriangleMesh full = ridge();
  for (std::size_t v = 0; v < full.vertices.size(); ++v)
    full.vertices[v].sigma_mm = static_cast<float>(v);
  for (const SurfacePoint& p : with(full, simplified(full)).vertices) {
    const SurfacePoint& former = full.vertices[static_cast<std::size_t>(p.sigma_mm)];
    EXPECT_EQ(p.position_mm, former.position_mm);
    EXPECT_EQ(p.normal, former.normal);
  }
}

TEST(Simplify, LeavesNoSliversAndAManifold) {
  const TriangleMesh full = ridge();
  const MeshQuality quality = mesh_quality(with(full, simplified(full)));
  EXPECT_TRUE(quality.is_manifold);
  EXPECT_TRUE(quality.is_oriented);
  EXPECT_EQ(quality.components, 1U);
  EXPECT_EQ(quality.sliver_share, 0.0);
  EXPECT_EQ(quality.turned, 0U);
}

TEST(Simplify, KeepsRimsAndHoles) {
  TriangleMesh full = ridge();
  std::erase_if(full.triangles, [&](const Triangle& t) {
    return (full.vertices[t[0]].position_mm - Vec3f(1.5F, 2.0F, 0.3F)).head<2>().norm() < 0.7F;
  });
  drop_unused_vertices(full);
  const TriangleMesh light = with(full, simplified(full));
  const std::vector<BoundaryLoop> before = find_boundaries(full), after = find_boundaries(light);
  ASSERT_EQ(after.size(), before.size());
  for (std::size_t i = 0; i < after.size(); ++i) {
    EXPECT_NEAR(after[i].area_mm2, before[i].area_mm2, 0.01 * before[i].perimeter_mm);
    EXPECT_LT(after[i].vertices.size(), before[i].vertices.size());
    EXPECT_EQ(after[i].is_outer, before[i].is_outer);
  }
}

/// The two sides of a seam of the texture have vertices of their own, at the same positions.
TEST(Simplify, KeepsBothSidesOfASeamTogether) {
  const TriangleMesh uncut = ridge();
  TriangleMesh cut = uncut;
  constexpr float kSeam_mm = 0.05F;  // between two columns
  std::vector<std::uint32_t> copies(uncut.vertices.size(), 0);
  for (Triangle& t : cut.triangles) {
    const float middle =
        (uncut.vertices[t[0]].position_mm.x() + uncut.vertices[t[1]].position_mm.x() +
         uncut.vertices[t[2]].position_mm.x()) /
        3.0F;
    if (middle < kSeam_mm) continue;
    for (std::uint32_t& v : t) {
      if (std::abs(uncut.vertices[v].position_mm.x()) > 0.01F) continue;
      if (copies[v] == 0) {
        copies[v] = static_cast<std::uint32_t>(cut.vertices.size());
        cut.vertices.push_back(SurfacePoint(uncut.vertices[v]));
      }
      v = copies[v];
    }
  }
  ASSERT_GT(cut.vertices.size(), uncut.vertices.size() + 50);
  const TriangleMesh light = with(cut, simplified(cut));
  EXPECT_LT(light.triangles.size(), uncut.triangles.size() / 4);
  const MeshQuality quality = mesh_quality(welded(light));
  EXPECT_TRUE(quality.is_manifold);
  EXPECT_EQ(quality.boundaries, 1U) << "the seam gapes";
  for (const SurfacePoint& p : light.vertices) {
    if (p.position_mm.x() == 0.0F) return;
  }
  ADD_FAILURE() << "the seam is gone";
}

TEST(Simplify, RefusesLimitsThatAreNone) {
  EXPECT_EQ(simplify(ridge(), {.max_rms_mm = 0.0}).error().code, ErrorCode::kBadOption);
  EXPECT_EQ(simplify(ridge(), {.max_mm = -1.0}).error().code, ErrorCode::kBadOption);
}

TEST(Simplify, StopsWhenCancelled) {
  const Progress progress;
  progress.cancel();
  EXPECT_EQ(simplify(ridge(), {}, progress).error().code, ErrorCode::kCancelled);
}

}  // namespace
}  // namespace flytri::meshing
