#include "ui/panels/scene_image.h"

namespace flytri::ui {

void SceneImage::add(const Framebuffer& picture, const Rect& place) {
  picture_ = &picture;
  place_ = place;
  window_height_px_ = ImGui::GetIO().DisplaySize.y;
  const auto call = [](const ImDrawList* /*list*/, const ImDrawCmd* command) {
    static_cast<const SceneImage*>(command->UserCallbackData)->copy(command->ClipRect);
  };
  ImGui::GetWindowDrawList()->AddCallback(call, this);
}

void SceneImage::copy(const ImVec4& clip) const {
  const Rect shown = place_.intersected({clip.x, clip.y, clip.z - clip.x, clip.w - clip.y});
  if (shown.width < 1.0F || shown.height < 1.0F) return;
  // OpenGL counts from below.
  const auto px = [](float x, float y) {
    return Eigen::Vector2i(static_cast<int>(x), static_cast<int>(y));
  };
  const Eigen::Vector2i from = px(shown.x - place_.x, place_.bottom() - shown.bottom());
  const PixelBox part(from, from + px(shown.width - 1.0F, shown.height - 1.0F));
  glDisable(GL_SCISSOR_TEST);
  picture_->copy_to_bound(part, px(shown.x, window_height_px_ - shown.bottom()));
  glEnable(GL_SCISSOR_TEST);
}

}  // namespace flytri::ui
