/// @file  Rectangles of the window, in pixels from its upper left corner, and ways to cut them up.
#pragma once

#include <imgui.h>

#include <algorithm>

namespace flytri::ui {

struct Rect {
  float x = 0.0F, y = 0.0F, width = 0.0F, height = 0.0F;

  [[nodiscard]] float right() const { return x + width; }
  [[nodiscard]] float bottom() const { return y + height; }
  [[nodiscard]] ImVec2 min() const { return {x, y}; }
  [[nodiscard]] ImVec2 max() const { return {right(), bottom()}; }
  [[nodiscard]] ImVec2 size() const { return {width, height}; }
  [[nodiscard]] ImVec2 center() const { return {x + width / 2.0F, y + height / 2.0F}; }
  [[nodiscard]] bool contains(const ImVec2& p) const {
    return p.x >= x && p.x < right() && p.y >= y && p.y < bottom();
  }
  /// The common part; of size 0 if there is none.
  [[nodiscard]] Rect intersected(const Rect& other) const {
    const float left = std::max(x, other.x), top = std::max(y, other.y);
    return {left, top, std::max(std::min(right(), other.right()) - left, 0.0F),
            std::max(std::min(bottom(), other.bottom()) - top, 0.0F)};
  }
  /// Smaller by a margin on each side, never below nothing.
  [[nodiscard]] Rect inset(float dx, float dy) const {
    return {x + dx, y + dy, std::max(width - 2.0F * dx, 0.0F), std::max(height - 2.0F * dy, 0.0F)};
  }
  [[nodiscard]] Rect inset(float margin) const { return inset(margin, margin); }

  // Cut off a part; the rectangle becomes the rest, minus a gap.
  Rect take_top(float h, float gap = 0.0F) {
    const Rect part = {x, y, width, std::min(h, height)};
    const float used = std::min(h + gap, height);
    y += used;
    height -= used;
    return part;
  }
  Rect take_bottom(float h, float gap = 0.0F) {
    const Rect part = {x, bottom() - std::min(h, height), width, std::min(h, height)};
    height -= std::min(h + gap, height);
    return part;
  }
  Rect take_left(float w, float gap = 0.0F) {
    const Rect part = {x, y, std::min(w, width), height};
    const float used = std::min(w + gap, width);
    x += used;
    width -= used;
    return part;
  }
  Rect take_right(float w, float gap = 0.0F) {
    const Rect part = {right() - std::min(w, width), y, std::min(w, width), height};
    width -= std::min(w + gap, width);
    return part;
  }
  /// A rectangle of that size in the middle.
  [[nodiscard]] Rect centered(float w, float h) const {
    return {x + (width - w) / 2.0F, y + (height - h) / 2.0F, w, h};
  }
};

/// The largest centered rectangle in `box` with the aspect ratio of a picture.
[[nodiscard]] inline Rect fitted(const Rect& box, float picture_width, float picture_height) {
  const float factor = std::min(box.width / picture_width, box.height / picture_height);
  return box.centered(picture_width * factor, picture_height * factor);
}

}  // namespace flytri::ui
