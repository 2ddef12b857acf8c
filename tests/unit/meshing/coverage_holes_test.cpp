#include "core/meshing/coverage_holes.h"

#include <gtest/gtest.h>

namespace flytri::meshing {
namespace {

BoundaryLoop rim(double width_mm) {
  BoundaryLoop loop;
  loop.width_mm = width_mm;
  return loop;
}

TEST(CoverageHoles, AreWideEnoughSortedByWidthAndWithoutTheBorder) {
  BoundaryLoop border = rim(40.0);
  border.is_outer = true;
  // A long crack has a larger area than a hole that is wider.
  BoundaryLoop crack = rim(0.95);
  crack.area_mm2 = 50.0;
  const auto holes = coverage_holes({border, rim(1.1), crack, rim(3.0)}, 1.0);
  ASSERT_EQ(holes.size(), 2U);
  EXPECT_EQ(holes[0].width_mm, 3.0);
  EXPECT_EQ(holes[1].width_mm, 1.1);
}

}  // namespace
}  // namespace flytri::meshing
