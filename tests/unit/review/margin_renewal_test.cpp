#include "core/review/margin_renewal.h"

#include <gtest/gtest.h>

#include "core/review/reviewed.h"
#include "tests/support/revolved.h"

namespace flytri::review {
namespace {

using testing::Preparation;
using testing::preparation;

std::vector<Vec3> five_of(const std::vector<Vec3>& line_mm) {
  std::vector<Vec3> places_mm;
  for (std::size_t i = 0; i < 5; ++i) places_mm.push_back(line_mm[i * line_mm.size() / 5]);
  return places_mm;
}

TriangleMesh moved(TriangleMesh mesh, const Vec3f& by_mm) {
  for (SurfacePoint& vertex : mesh.vertices) vertex.position_mm += by_mm;
  return mesh;
}

/// A margin line that was drawn on a preparation.
class DrawnMarginLine : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    tooth_ = preparation({});
    clicks_mm_ = five_of(tooth_.margin_mm);
    margin_ = find_margin(made_ready(tooth_.mesh), clicks_mm_, {}, Workers()).value();
  }
  static std::optional<Margin> margin_on(const TriangleMesh& model) {
    const TriangleMesh mesh = made_ready(model);
    return on_surface(margin_, clicks_mm_, mesh, MeshDistance(mesh), Workers());
  }

  static inline Preparation tooth_;
  static inline std::vector<Vec3> clicks_mm_;
  static inline Margin margin_;
};

TEST_F(DrawnMarginLine, StaysAsItIsOnItsOwnSurface) {
  const auto margin = margin_on(tooth_.mesh);
  ASSERT_TRUE(margin);
  ASSERT_EQ(margin->line.points.size(), margin_.line.points.size());
  for (std::size_t i = 0; i < margin_.line.points.size(); ++i)
    EXPECT_EQ(margin->line.points[i].position_mm, margin_.line.points[i].position_mm);
}

TEST_F(DrawnMarginLine, IsFoundAnewOnASurfaceThatWasFinishedAgain) {
  // Another alignment moves the surface; its noise is another one, too.
  const TriangleMesh again = moved(preparation({.seed = 7}).mesh, {0.05F, 0.0F, -0.03F});
  EXPECT_FALSE(lies_on(margin_.line, MeshDistance(again)));
  const auto margin = margin_on(again);
  ASSERT_TRUE(margin);
  EXPECT_TRUE(lies_on(margin->line, MeshDistance(again)));
}

TEST_F(DrawnMarginLine, IsOutdatedWhereTheEdgeIsNoLonger) {
  EXPECT_FALSE(margin_on(moved(tooth_.mesh, {2.0F, 0.0F, 0.0F}))) << "no edge near the clicks";
  EXPECT_FALSE(margin_on(moved(tooth_.mesh, {0.0F, 0.0F, -0.4F})))
      << "the clicks still snap to the edge, but it is not where it was";
}

}  // namespace
}  // namespace flytri::review
