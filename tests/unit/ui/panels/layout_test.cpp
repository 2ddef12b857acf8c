#include "ui/panels/layout.h"

#include <gtest/gtest.h>

namespace flytri::ui {
namespace {

float area(const Rect& rect) { return rect.width * rect.height; }

TEST(Layout, PartsFillTheWindowWithoutOverlap) {
  for (const auto& [width, height] :
       {std::pair{1280.0F, 800.0F}, {1024.0F, 640.0F}, {2560.0F, 1600.0F}}) {
    for (const float scale : {0.5F, 1.0F, 1.5F, 2.0F}) {
      Theme theme;
      theme.scale = scale;
      const Layout layout = make_layout(width, height, theme);
      EXPECT_FLOAT_EQ(layout.top.bottom(), layout.frame.y);
      EXPECT_FLOAT_EQ(layout.frame.bottom(), layout.bottom.y);
      EXPECT_FLOAT_EQ(layout.frame.right(), layout.side.x);
      EXPECT_FLOAT_EQ(layout.side.right(), width);
      EXPECT_FLOAT_EQ(layout.bottom.bottom(), height);
      EXPECT_FLOAT_EQ(
          area(layout.top) + area(layout.bottom) + area(layout.side) + area(layout.frame),
          width * height);
    }
  }
}

TEST(Layout, TheStatusFrameGoesAllAroundThePicture) {
  const Theme theme;
  const Layout layout = make_layout(1280.0F, 800.0F, theme);
  EXPECT_FLOAT_EQ(layout.picture.x - layout.frame.x, layout.frame.right() - layout.picture.right());
  EXPECT_FLOAT_EQ(layout.picture.y - layout.frame.y,
                  layout.frame.bottom() - layout.picture.bottom());
  EXPECT_GE(layout.picture.x - layout.frame.x, 8.0F) << "too thin to be seen from two meters";
}

TEST(WindowScale, IsContentTimesUserInSteps) {
  EXPECT_FLOAT_EQ(window_scale(1.0, 1.0, 1280, 800), 1.0F);
  EXPECT_FLOAT_EQ(window_scale(2.0, 1.0, 2560, 1600), 2.0F);
  EXPECT_FLOAT_EQ(window_scale(1.0, 1.0, 2560, 1440), 1.375F) << "texts grow with the window";
  EXPECT_FLOAT_EQ(window_scale(1.0, 1.0, 7680, 4320), 1.5F);
  EXPECT_FLOAT_EQ(window_scale(1.5, 1.25, 2400, 1500), 1.875F);
}

TEST(WindowScale, LeavesRoomForTheFixedParts) {
  // At least 1024 x 640 units stay, unless that would make texts unreadable.
  EXPECT_FLOAT_EQ(window_scale(2.0, 2.0, 1280, 800), 1.25F);
  EXPECT_FLOAT_EQ(window_scale(1.0, 1.0, 300, 200), 0.5F);
  EXPECT_FLOAT_EQ(window_scale(4.0, 2.0, 10000, 10000), 4.0F);
}

TEST(Rect, TakingPartsLeavesTheRest) {
  Rect rest = {0.0F, 0.0F, 100.0F, 50.0F};
  const Rect top = rest.take_top(10.0F, 5.0F);
  const Rect right = rest.take_right(30.0F, 10.0F);
  EXPECT_FLOAT_EQ(top.height, 10.0F);
  EXPECT_FLOAT_EQ(right.x, 70.0F);
  EXPECT_FLOAT_EQ(rest.y, 15.0F);
  EXPECT_FLOAT_EQ(rest.width, 60.0F);
  EXPECT_FLOAT_EQ(rest.height, 35.0F);
  // More than there is: all of it.
  EXPECT_FLOAT_EQ(rest.take_bottom(1000.0F).height, 35.0F);
  EXPECT_FLOAT_EQ(rest.height, 0.0F);
}

}  // namespace
}  // namespace flytri::ui
