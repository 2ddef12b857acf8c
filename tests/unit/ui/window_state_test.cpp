#include "ui/state/window_state.h"

#include <gtest/gtest.h>

#include <vector>

namespace flytri::ui {
namespace {

meshing::BoundaryLoop hole_at(float x_mm, double width_mm) {
  meshing::BoundaryLoop hole;
  hole.center_mm = Vec3f(x_mm, 0.0F, 0.0F);
  hole.width_mm = width_mm;
  return hole;
}

const SelectedHole kSelected{2, Vec3f::Zero(), 2.0};

TEST(SelectedHole, IsFoundAtItsNewIndex) {
  const std::vector<meshing::BoundaryLoop> holes = {hole_at(20.0F, 3.0), hole_at(0.4F, 1.0)};
  const auto found = found_again(kSelected, holes);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->index, 1U);
  EXPECT_NEAR(found->width_mm, 1.0, 1e-9);
}

TEST(SelectedHole, TheNearestPartStaysSelectedAfterASplit) {
  const std::vector<meshing::BoundaryLoop> holes = {hole_at(0.8F, 0.9), hole_at(-0.5F, 0.6)};
  EXPECT_EQ(found_again(kSelected, holes)->index, 1U);
}

TEST(SelectedHole, IsNoneOnceTheHoleIsClosed) {
  EXPECT_FALSE(found_again(kSelected, std::vector<meshing::BoundaryLoop>{hole_at(1.1F, 5.0)}));
  EXPECT_FALSE(found_again(kSelected, {}));
}

TEST(TypedLength, IsAPositiveNumberOnly) {
  EXPECT_EQ(typed_length_mm("10.5"), 10.5);
  for (const char* text : {"", "ten", "10 mm", "0", "-3", "1e999"}) {
    EXPECT_FALSE(typed_length_mm(text)) << text;
  }
}

}  // namespace
}  // namespace flytri::ui
