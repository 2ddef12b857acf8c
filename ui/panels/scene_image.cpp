#include "ui/panels/scene_image.h"

#include "ui/widgets/pixel_rows.h"

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
  const Rect part = {shown.x - place_.x, shown.y - place_.y, shown.width, shown.height};
  glDisable(GL_SCISSOR_TEST);
  picture_->copy_to_bound(from_below(part, place_.height),
                          from_below(shown, window_height_px_).min());
  glEnable(GL_SCISSOR_TEST);
}

}  // namespace flytri::ui
