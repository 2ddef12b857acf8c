/// @file  The middle of the window: the scene in its frame, and what the pointer does there.
#include "ui/panels/panels.h"
#include "ui/panels/scene_input.h"
#include "ui/panels/scene_view.h"
#include "ui/panels/status.h"

namespace flytri::ui {
namespace {

/// Where the scene's picture is another one than before, in the window.
void tell_repainted(const PanelContext& context) {
  const PixelBox& part = context.scene.repainted_px();
  if (part.isEmpty()) return;
  const Rect& picture = context.layout.picture;
  const Eigen::Array2f corner = part.min().cast<float>(),
                       size = (part.sizes() + Eigen::Vector2i::Ones()).cast<float>();
  context.repainted.push_back(
      {picture.x + corner.x(), picture.bottom() - corner.y() - size.y(), size.x(), size.y()});
}

}  // namespace

void draw_scene_panel(const PanelContext& context) {
  const Rect& picture = context.layout.picture;
  const Plate plate("scene", context.layout.frame,
                    {Layer::kFixed, status_of(context.view).color, 0.0F});
  context.places.set("scene", picture);
  ImGui::SetCursorScreenPos(picture.min());
  ImGui::InvisibleButton("picture", picture.size(),
                         ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight |
                             ImGuiButtonFlags_MouseButtonMiddle);
  handle_scene_input(context);
  draw_scene(context);
  tell_repainted(context);
  context.pictures.scene.add(context.scene.picture(), picture);
  draw_distance_labels(context);
}

}  // namespace flytri::ui
