#include "core/meshing/trim_rims.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/geometry/mesh_normals.h"
#include "core/meshing/half_edges.h"
#include "core/meshing/mesh_topology.h"

namespace flytri::meshing {
namespace {

constexpr std::uint32_t kSide = 40;  ///< cells
constexpr float kCell_mm = 0.1F;

/// A square of 4 mm without some cells.
TriangleMesh plate_without(bool (*is_cut_out)(std::uint32_t column, std::uint32_t row)) {
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < (kSide + 1) * (kSide + 1); ++i) {
    SurfacePoint& vertex = mesh.vertices.emplace_back();
    vertex.position_mm = {kCell_mm * static_cast<float>(i % (kSide + 1)),
                          kCell_mm * static_cast<float>(i / (kSide + 1)), 0.0F};
    vertex.normal = Vec3f::UnitZ();
  }
  for (std::uint32_t row = 0; row < kSide; ++row) {
    for (std::uint32_t column = 0; column < kSide; ++column) {
      if (is_cut_out(column, row)) continue;
      const std::uint32_t v = row * (kSide + 1) + column, above = v + kSide + 1;
      mesh.triangles.push_back({v, v + 1, above + 1});
      mesh.triangles.push_back({v, above + 1, above});
    }
  }
  drop_islands(mesh, 0.0);
  return mesh;
}

double area_mm2(const TriangleMesh& mesh) {
  double area = 0.0;
  for (const Triangle& t : mesh.triangles) area += area_vector_mm2(mesh, t).z();
  return area;
}

float highest_mm(const TriangleMesh& mesh) {
  float highest = 0.0F;
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t v : t) highest = std::max(highest, mesh.vertices[v].position_mm.y());
  }
  return highest;
}

void expect_manifold(const TriangleMesh& mesh) {
  const std::vector<HalfEdge> edges = half_edges_of(mesh);
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    if (!edges[i].same_edge(edges[i + 1])) continue;
    EXPECT_NE(edges[i].rising, edges[i + 1].rising);
    if (i + 2 < edges.size()) {
      EXPECT_FALSE(edges[i].same_edge(edges[i + 2]));
    }
  }
  for (const Triangle& t : mesh.triangles) EXPECT_GT(area_vector_mm2(mesh, t).z(), 0.0);
}

TEST(TrimRims, ACombOfSingleLinesGoes) {
  TriangleMesh mesh = plate_without(
      [](std::uint32_t column, std::uint32_t row) { return row >= 20 && column % 6 >= 3; });
  trim_rims(mesh, 0.8F, kCell_mm, Workers(2));
  // The lines are 0.3 mm wide; the plate below them is 2 mm high.
  EXPECT_NEAR(highest_mm(mesh), 2.0F, 0.25F);
  EXPECT_NEAR(area_mm2(mesh), 8.0, 0.5);
  expect_manifold(mesh);
}

TEST(TrimRims, AThinBridgeGoesAndBothSidesStay) {
  TriangleMesh mesh = plate_without([](std::uint32_t column, std::uint32_t row) {
    return column >= 15 && column < 25 && (row < 18 || row >= 21);
  });
  trim_rims(mesh, 0.8F, kCell_mm, Workers(2));
  EXPECT_NEAR(area_mm2(mesh), 12.0, 0.4);
  expect_manifold(mesh);
  const std::vector<BoundaryLoop> loops = find_boundaries(mesh);
  ASSERT_EQ(loops.size(), 2U);
  EXPECT_TRUE(loops[0].is_outer && loops[1].is_outer);
}

TEST(TrimRims, AScanOfNothingButLinesStays) {
  TriangleMesh mesh =
      plate_without([](std::uint32_t column, std::uint32_t /*row*/) { return column % 6 >= 3; });
  const double before_mm2 = area_mm2(mesh);
  trim_rims(mesh, 0.8F, kCell_mm, Workers(2));
  EXPECT_EQ(area_mm2(mesh), before_mm2);
}

TEST(TrimRims, PinholesCostNothingAroundThem) {
  const auto has_pinholes = [](std::uint32_t column, std::uint32_t row) {
    return column % 5 == 2 && row % 5 == 2 && column > 5 && column < 35 && row > 5 && row < 35;
  };
  TriangleMesh mesh = plate_without(has_pinholes);
  const double before_mm2 = area_mm2(mesh);
  trim_rims(mesh, 0.8F, kCell_mm, Workers(2));
  EXPECT_NEAR(area_mm2(mesh), before_mm2, 0.2);
  expect_manifold(mesh);
}

TEST(TrimRims, PinholesAlongARimGoWithIt) {
  const auto has_pinholes = [](std::uint32_t column, std::uint32_t row) {
    return column % 3 == 1 && (row == 37 || row == 20);
  };
  TriangleMesh mesh = plate_without(has_pinholes);
  trim_rims(mesh, 0.8F, kCell_mm, Workers(2));
  EXPECT_NEAR(highest_mm(mesh), 3.7F, 0.15F) << "the row at 3.7 mm is the rim";
  EXPECT_GT(find_boundaries(mesh).size(), 10U) << "the row inside stays";
  EXPECT_NEAR(area_mm2(mesh), 4.0 * 3.7, 0.4);
  expect_manifold(mesh);
}

TEST(TrimRims, AJaggedRimBecomesSmoothAndStaysWhereItWas) {
  TriangleMesh mesh =
      plate_without([](std::uint32_t column, std::uint32_t row) { return row >= 30 + column % 2; });
  const double before_mm2 = area_mm2(mesh);
  const double jagged_mm = find_boundaries(mesh).front().perimeter_mm;
  trim_rims(mesh, 0.8F, kCell_mm, Workers(2));
  EXPECT_LT(find_boundaries(mesh).front().perimeter_mm, jagged_mm - 2.0);
  EXPECT_NEAR(area_mm2(mesh), before_mm2, 0.04 * before_mm2);
  expect_manifold(mesh);
}

/// Vertical lines below, and above 2 mm of one pattern alone.
void mark_crossed_up_to(TriangleMesh& mesh, float crossed_mm) {
  for (SurfacePoint& vertex : mesh.vertices) {
    vertex.patterns = set_of(Pattern::kVertical);
    if (vertex.position_mm.y() <= crossed_mm) vertex.patterns |= set_of(Pattern::kHorizontal);
  }
}

TEST(TrimRims, WhatOnePatternAloneMeasuredGoes) {
  TriangleMesh mesh = plate_without([](std::uint32_t, std::uint32_t) { return false; });
  TriangleMesh not_known = mesh;
  mark_crossed_up_to(mesh, 2.5F);
  trim_rims(mesh, 0.8F, kCell_mm, Workers(2));
  // A line confirms what is nearer than most of a strip.
  EXPECT_NEAR(highest_mm(mesh), 2.5F + 0.68F, 0.15F);
  expect_manifold(mesh);
  trim_rims(not_known, 0.8F, kCell_mm, Workers(2));
  EXPECT_NEAR(highest_mm(not_known), 4.0F, 0.05F) << "nothing says who measured it";
}

TEST(TrimRims, WhatOnePatternMeasuredStaysInside) {
  TriangleMesh mesh = plate_without([](std::uint32_t, std::uint32_t) { return false; });
  for (SurfacePoint& vertex : mesh.vertices) {
    const bool is_inside = (vertex.position_mm - Vec3f(2.0F, 2.0F, 0.0F)).norm() < 1.2F;
    vertex.patterns = set_of(Pattern::kVertical);
    if (!is_inside) vertex.patterns |= set_of(Pattern::kHorizontal);
  }
  TriangleMesh trimmed = mesh;
  trim_rims(trimmed, 0.8F, kCell_mm, Workers(2));
  EXPECT_EQ(find_boundaries(trimmed).size(), 1U);
}

}  // namespace
}  // namespace flytri::meshing
