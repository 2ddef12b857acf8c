#include "core/editing/edits.h"

#include <gtest/gtest.h>

namespace flytri::editing {
namespace {

Edit stroke(EditKind kind, double made_at_s, float x_mm = 0.0F) {
  return {kind, made_at_s, {{Vec3f(x_mm, 0, 0), Vec3f::UnitZ(), 1.0F}}};
}

bool keeps(const EditStack& stack, double seen_at_s, const Vec3f& position = Vec3f::Zero(),
           const Vec3f& normal = Vec3f::UnitZ()) {
  return EditFilter(stack.state()).keeps(position, normal, seen_at_s);
}

TEST(Edits, TrimRemovesEarlierSurfaceAndAllowsNewSurface) {
  EditStack stack;
  stack.push(stroke(EditKind::kTrim, 5.0));
  EXPECT_FALSE(keeps(stack, 4.0));
  EXPECT_FALSE(keeps(stack, 5.0));
  EXPECT_TRUE(keeps(stack, 5.1));
}

TEST(Edits, ABrushReachesOnlySurfaceInItsBallThatFacesTheUser) {
  EditStack stack;
  stack.push(stroke(EditKind::kTrim, 5.0));
  EXPECT_FALSE(keeps(stack, 1.0, Vec3f(0.99F, 0, 0)));
  EXPECT_TRUE(keeps(stack, 1.0, Vec3f(1.01F, 0, 0)));
  EXPECT_TRUE(keeps(stack, 1.0, Vec3f::Zero(), -Vec3f::UnitZ()));
}

TEST(Edits, ALockKeepsEarlierSurfaceAndRejectsNewSurface) {
  EditStack stack;
  stack.push(stroke(EditKind::kLock, 5.0));
  stack.push(stroke(EditKind::kTrim, 8.0));
  EXPECT_TRUE(keeps(stack, 4.0));
  EXPECT_FALSE(keeps(stack, 6.0));
  EXPECT_FALSE(keeps(stack, 9.0));
}

TEST(Edits, ASecondLockDoesNotEndTheFirst) {
  EditStack stack;
  stack.push(stroke(EditKind::kLock, 5.0));
  stack.push(stroke(EditKind::kLock, 8.0));
  EXPECT_FALSE(keeps(stack, 6.0));
}

TEST(Edits, UnlockAllowsLaterSurfaceButNotSurfaceRejectedBefore) {
  EditStack stack;
  stack.push(stroke(EditKind::kLock, 5.0));
  stack.push(stroke(EditKind::kUnlock, 10.0));
  EXPECT_TRUE(keeps(stack, 4.0));
  EXPECT_FALSE(keeps(stack, 7.0));
  EXPECT_TRUE(keeps(stack, 11.0));
  stack.push(stroke(EditKind::kTrim, 12.0));
  EXPECT_FALSE(keeps(stack, 4.0));
}

TEST(Edits, TellWhenAPlaceWasTouched) {
  EditStack stack;
  stack.push(stroke(EditKind::kTrim, 5.0));
  stack.push(stroke(EditKind::kLock, 8.0, 9.0F));
  stack.push(stroke(EditKind::kLock, 9.0, 0.5F));
  const EditFilter filter(stack.state());
  EXPECT_EQ(filter.times_at(Vec3f::Zero()), (std::vector<double>{5.0, 9.0}));
  EXPECT_TRUE(filter.touches(Vec3f(9, 0, 0)));
  EXPECT_FALSE(filter.touches(Vec3f(4, 0, 0)));
  EXPECT_TRUE(filter.times_at(Vec3f(4, 0, 0)).empty());
}

TEST(Edits, TheDifferenceHoldsWhatOnlyOneListHas) {
  EditStack stack;
  stack.push(stroke(EditKind::kTrim, 5.0));
  const EditList one = stack.state();
  stack.push(stroke(EditKind::kTrim, 6.0));
  const EditList two = stack.state();
  EXPECT_TRUE(difference(two, two)->empty());
  ASSERT_EQ(difference(one, two)->size(), 1U);
  EXPECT_EQ(difference(one, two)->front(), two->back());
  EXPECT_EQ(difference(two, one)->front(), two->back());
}

TEST(EditStack, UndoAndRedoGoThroughTheStates) {
  EditStack stack;
  EXPECT_FALSE(stack.can_undo());
  stack.push(stroke(EditKind::kTrim, 1.0));
  const EditList one = stack.state();
  stack.push(stroke(EditKind::kTrim, 2.0, 9.0F));
  stack.undo();
  EXPECT_EQ(stack.state(), one);
  EXPECT_TRUE(stack.can_redo());
  stack.redo();
  EXPECT_EQ(stack.state()->size(), 2U);
  stack.undo();
  stack.undo();
  EXPECT_TRUE(stack.state()->empty());
  EXPECT_TRUE(keeps(stack, 0.5));
}

TEST(EditStack, ANewEditDiscardsUndoneEdits) {
  EditStack stack;
  stack.push(stroke(EditKind::kTrim, 1.0));
  stack.undo();
  stack.push(stroke(EditKind::kLock, 2.0));
  EXPECT_FALSE(stack.can_redo());
  ASSERT_EQ(stack.state()->size(), 1U);
  EXPECT_EQ(stack.state()->front()->kind, EditKind::kLock);
}

TEST(EditStack, UndoAndRedoDoNothingWithoutEdits) {
  EditStack stack;
  stack.undo();
  stack.redo();
  EXPECT_TRUE(stack.state()->empty());
}

}  // namespace
}  // namespace flytri::editing
