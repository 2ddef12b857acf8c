#include "ui/panels/layout.h"

#include <cmath>

namespace flytri::ui {
namespace {

// In units, pixels at 100 %.
constexpr float kTop = 64.0F;
constexpr float kBottom = 112.0F;
constexpr float kSide = 336.0F;
constexpr float kNarrowSide = 272.0F;
constexpr float kNarrowWindow = 1180.0F;
/// A band as wide as a finger is seen across the room.
constexpr float kStatusFrame = 10.0F;

/// The picture is copied pixel by pixel.
Rect whole_pixels(const Rect& rect) {
  const float x = std::ceil(rect.x), y = std::ceil(rect.y);
  return {x, y, std::floor(rect.right()) - x, std::floor(rect.bottom()) - y};
}

}  // namespace

Layout make_layout(float width_px, float height_px, const Theme& theme) {
  Layout layout;
  layout.window = {0.0F, 0.0F, width_px, height_px};
  Rect rest = layout.window;
  layout.top = rest.take_top(theme.px(kTop));
  layout.bottom = rest.take_bottom(theme.px(kBottom));
  const bool is_narrow = width_px < kNarrowWindow * theme.scale;
  layout.side = rest.take_right(theme.px(is_narrow ? kNarrowSide : kSide));
  layout.frame = rest;
  layout.picture = whole_pixels(rest.inset(theme.px(kStatusFrame)));
  return layout;
}

}  // namespace flytri::ui
