#include "ui/window/draw_damage.h"

#include <gtest/gtest.h>

#include <functional>

namespace flytri::ui {
namespace {

constexpr float kWidth_px = 640.0F, kHeight_px = 400.0F;

/// A context of Dear ImGui without a window system, and frames that are drawn in it.
class DrawDamageTest : public ::testing::Test {
 protected:
  DrawDamageTest() : context_(ImGui::CreateContext()) {
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.DisplaySize = {kWidth_px, kHeight_px};
    unsigned char* pixels = nullptr;
    int width = 0, height = 0;
    io.Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
  }
  ~DrawDamageTest() override { ImGui::DestroyContext(context_); }
  DrawDamageTest(const DrawDamageTest&) = delete;
  DrawDamageTest& operator=(const DrawDamageTest&) = delete;

  std::vector<Rect> boxes_of(const std::function<void(ImDrawList&)>& draw,
                             const std::vector<Rect>& repainted = {}) {
    ImGui::NewFrame();
    draw(*ImGui::GetForegroundDrawList());
    ImGui::Render();
    return damage_.update(*ImGui::GetDrawData(), repainted);
  }

  DrawDamage damage_;

 private:
  ImGuiContext* context_;
};

std::function<void(ImDrawList&)> square_at(float x, ImU32 color = IM_COL32_WHITE) {
  return [=](ImDrawList& list) { list.AddRectFilled({x, 100.0F}, {x + 20.0F, 120.0F}, color); };
}

bool holds(const std::vector<Rect>& boxes, const Rect& rect) {
  return std::any_of(boxes.begin(), boxes.end(), [&](const Rect& box) {
    return box.x <= rect.x && box.y <= rect.y && box.right() >= rect.right() &&
           box.bottom() >= rect.bottom();
  });
}

double area_of(const std::vector<Rect>& boxes) {
  double area = 0.0;
  for (const Rect& box : boxes) area += static_cast<double>(box.width) * box.height;
  return area;
}

TEST_F(DrawDamageTest, TheFirstFrameIsCompletelyNew) {
  EXPECT_TRUE(holds(boxes_of(square_at(100.0F)), {0.0F, 0.0F, kWidth_px, kHeight_px}));
}

TEST_F(DrawDamageTest, TheSameFrameAgainHasNoChanges) {
  boxes_of(square_at(100.0F));
  EXPECT_TRUE(boxes_of(square_at(100.0F)).empty());
}

TEST_F(DrawDamageTest, AMoveChangesTheOldAndTheNewPlace) {
  boxes_of(square_at(100.0F));
  const std::vector<Rect> boxes = boxes_of(square_at(500.0F));
  EXPECT_TRUE(holds(boxes, {100.0F, 100.0F, 20.0F, 20.0F}));
  EXPECT_TRUE(holds(boxes, {500.0F, 100.0F, 20.0F, 20.0F}));
  EXPECT_LT(area_of(boxes), 0.1 * kWidth_px * kHeight_px);
}

TEST_F(DrawDamageTest, AnotherColorIsAChange) {
  boxes_of(square_at(100.0F));
  EXPECT_TRUE(holds(boxes_of(square_at(100.0F, IM_COL32_BLACK)), {100.0F, 100.0F, 20.0F, 20.0F}));
}

TEST_F(DrawDamageTest, AnotherOrderIsAChange) {
  const auto both = [](float first, float second) {
    return [=](ImDrawList& list) {
      list.AddRectFilled({first, 100.0F}, {first + 20.0F, 120.0F}, IM_COL32_WHITE);
      list.AddRectFilled({second, 100.0F}, {second + 20.0F, 120.0F}, IM_COL32_WHITE);
    };
  };
  boxes_of(both(100.0F, 110.0F));
  EXPECT_FALSE(boxes_of(both(110.0F, 100.0F)).empty());
}

TEST_F(DrawDamageTest, ClippedPartsAreNotChanges) {
  const auto clipped = [](ImU32 color) {
    return [=](ImDrawList& list) {
      list.PushClipRect({0.0F, 0.0F}, {64.0F, 64.0F});
      list.AddRectFilled({0.0F, 0.0F}, {kWidth_px, kHeight_px}, color);
      list.PopClipRect();
    };
  };
  boxes_of(clipped(IM_COL32_WHITE));
  const std::vector<Rect> boxes = boxes_of(clipped(IM_COL32_BLACK));
  EXPECT_TRUE(holds(boxes, {0.0F, 0.0F, 64.0F, 64.0F}));
  EXPECT_LT(area_of(boxes), 0.1 * kWidth_px * kHeight_px);
}

TEST_F(DrawDamageTest, ARepaintedTextureIsAChange) {
  boxes_of(square_at(100.0F));
  const Rect image = {33.0F, 65.0F, 90.0F, 70.0F};
  const std::vector<Rect> boxes = boxes_of(square_at(100.0F), {image});
  EXPECT_TRUE(holds(boxes, image));
  EXPECT_LT(area_of(boxes), 0.1 * kWidth_px * kHeight_px);
}

TEST_F(DrawDamageTest, ManyChangesGiveFewBoxesThatContainThemAll) {
  const auto squares = [](int offset) {
    return [=](ImDrawList& list) {
      for (int i = 0; i < 20; ++i) {
        const float x = static_cast<float>(64 * (i % 5) * 2 + offset),
                    y = static_cast<float>(96 * (i / 5) + offset);
        list.AddRectFilled({x, y}, {x + 8.0F, y + 8.0F}, IM_COL32_WHITE);
      }
    };
  };
  boxes_of(squares(0));
  const std::vector<Rect> boxes = boxes_of(squares(2));
  EXPECT_LE(boxes.size(), 4U);
  for (int i = 0; i < 20; ++i) {
    EXPECT_TRUE(holds(boxes, {static_cast<float>(64 * (i % 5) * 2 + 2),
                              static_cast<float>(96 * (i / 5) + 2), 8.0F, 8.0F}));
  }
}

TEST_F(DrawDamageTest, AfterForgettingEverythingIsNew) {
  boxes_of(square_at(100.0F));
  damage_.forget();
  EXPECT_TRUE(holds(boxes_of(square_at(100.0F)), {0.0F, 0.0F, kWidth_px, kHeight_px}));
}

}  // namespace
}  // namespace flytri::ui
