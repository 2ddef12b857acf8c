#include "core/meshing/coverage_holes.h"

#include <gtest/gtest.h>

#include <numbers>

namespace flytri {
namespace {

BoundaryLoop round_rim(double width_mm) {
  BoundaryLoop loop;
  loop.perimeter_mm = std::numbers::pi * width_mm;
  loop.area_mm2 = std::numbers::pi / 4.0 * width_mm * width_mm;
  return loop;
}

TEST(CoverageHoles, AreThoseWideEnoughTheWidestFirstWithoutTheBorder) {
  BoundaryLoop border = round_rim(40.0);
  border.is_outer = true;
  // Its rim is the longest, and it encloses next to nothing.
  BoundaryLoop crack = round_rim(0.45);
  crack.perimeter_mm = 200.0;
  const auto holes = coverage_holes({border, round_rim(0.6), crack, round_rim(3.0)});
  ASSERT_EQ(holes.size(), 2U);
  EXPECT_NEAR(hole_width_mm(holes[0]), 3.0, 1e-9);
  EXPECT_NEAR(hole_width_mm(holes[1]), 0.6, 1e-9);
}

}  // namespace
}  // namespace flytri
