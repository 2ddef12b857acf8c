#include "assets/sample_jaw/sample_jaw.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "assets/shapes/surface_nets.h"

namespace flytri::sample_jaw {
namespace {

// Coarse: the shape is the same, the test is quick.
SampleJawOptions coarse(JawKind kind) {
  return {.kind = kind, .tooth_cell_mm = 0.5, .gum_cell_mm = 0.8};
}

TEST(SurfaceNets, ASphereIsMetToASmallShareOfACell) {
  const shapes::ImplicitShape ball = [](const Vec3& p) { return p.norm() - 3.03; };
  const TriangleMesh mesh =
      shapes::surface_nets(ball, {Vec3::Constant(-4.0), Vec3::Constant(4.0), 0.2});
  ASSERT_GT(mesh.triangles.size(), 1000U);
  for (const SurfacePoint& vertex : mesh.vertices) {
    // The mean of a cell's crossings lies inside by at most the sagitta of a cell's diagonal.
    EXPECT_NEAR(vertex.position_mm.norm(), 3.03, 0.2 * 0.2 / 3.0);
    EXPECT_GT(vertex.normal.dot(vertex.position_mm.normalized()), 0.97F);
  }
  // Euler: a closed sphere has V - E + F = 2 with E = 3 F / 2.
  EXPECT_EQ(mesh.vertices.size(), mesh.triangles.size() / 2 + 2);
}

TEST(SampleJaw, HasTheSizeAndTheColorsOfAJaw) {
  for (const JawKind kind : {JawKind::kUpper, JawKind::kLower}) {
    const TriangleMesh jaw = make_sample_jaw(coarse(kind), Workers(2)).value();
    Eigen::AlignedBox3f box;
    int gum = 0;
    for (const SurfacePoint& vertex : jaw.vertices) {
      box.extend(vertex.position_mm);
      // Gum is much redder than green; enamel is not.
      gum += vertex.color[0] > vertex.color[1] + 45 ? 1 : 0;
    }
    EXPECT_NEAR(box.sizes().x(), 75.0, 6.0);
    EXPECT_NEAR(box.sizes().y(), 57.0, 5.0);
    EXPECT_NEAR(box.sizes().z(), 22.0, 4.0);
    const double share = gum / static_cast<double>(jaw.vertices.size());
    EXPECT_GT(share, 0.2);
    EXPECT_LT(share, 0.8);
  }
}

TEST(SampleJaw, FourteenTeethStandOnTheArchAndNoneIsTheMirrorOfAnother) {
  const Dentition dentition = make_dentition(JawKind::kUpper, 1);
  ASSERT_EQ(dentition.teeth.size(), 14U);
  for (std::size_t i = 0; i < 7; ++i) {
    const ToothForm& a = dentition.teeth[i].tooth.form();
    const ToothForm& b = dentition.teeth[13 - i].tooth.form();
    EXPECT_EQ(a.name, b.name);
    EXPECT_NE(a.width_mm, b.width_mm);
  }
}

TEST(SampleJaw, NeighborsTouchButDoNotOverlapMuch) {
  for (const JawKind kind : {JawKind::kUpper, JawKind::kLower}) {
    const Dentition dentition = make_dentition(kind, 3);
    for (std::size_t i = 0; i + 1 < dentition.teeth.size(); ++i) {
      const double middle_mm =
          0.5 * (dentition.teeth[i].along_mm + dentition.teeth[i + 1].along_mm);
      double deepest_mm = 10.0;
      for (double along = middle_mm - 1.0; along < middle_mm + 1.0; along += 0.1)
        for (double outward = -3.0; outward < 3.0; outward += 0.2)
          for (double z = 4.0; z < 9.0; z += 0.25) {
            const Vec2 p = dentition.arch.point(along) + outward * dentition.arch.outward(along);
            const Vec3 p_jaw(p.x(), p.y(), z);
            deepest_mm = std::min(
                deepest_mm, std::max(dentition.teeth[i](p_jaw), dentition.teeth[i + 1](p_jaw)));
          }
      EXPECT_LT(deepest_mm, 0.35) << "teeth " << i << " and " << i + 1 << " leave a gap";
      EXPECT_GT(deepest_mm, -0.6) << "teeth " << i << " and " << i + 1 << " overlap";
    }
  }
}

TEST(SampleJaw, OneThreadAndManyGiveTheSameBits) {
  const TriangleMesh a = make_sample_jaw(coarse(JawKind::kLower), Workers(1)).value();
  const TriangleMesh b = make_sample_jaw(coarse(JawKind::kLower), Workers(2)).value();
  ASSERT_EQ(a.triangles, b.triangles);
  for (std::size_t i = 0; i < a.vertices.size(); ++i) {
    EXPECT_EQ(a.vertices[i].position_mm, b.vertices[i].position_mm);
    EXPECT_EQ(a.vertices[i].color, b.vertices[i].color);
  }
}

TEST(SampleJaw, NamesTheBadOption) {
  const auto jaw = make_sample_jaw({.gum_cell_mm = 0.0}, Workers(1));
  ASSERT_FALSE(jaw);
  EXPECT_NE(jaw.error().message.find("gum_cell_mm"), std::string::npos);
}

}  // namespace
}  // namespace flytri::sample_jaw
