/// @file  The middle of the window: the scene in its frame, and what the pointer does there.
#include "ui/panels/panels.h"
#include "ui/panels/scene_input.h"
#include "ui/panels/scene_view.h"
#include "ui/panels/status.h"
#include "ui/widgets/pixel_rows.h"

namespace flytri::ui {
namespace {

/// Reports the part of the window in which the scene changed.
void add_repainted(const PanelContext& context) {
  const PixelBox& part = context.scene.repainted_px();
  if (part.isEmpty()) return;
  const Rect& picture = context.layout.picture;
  Rect place = from_above(part, picture.height);
  place.x += picture.x;
  place.y += picture.y;
  context.repainted.push_back(place);
}

}  // namespace

void draw_scene_panel(const PanelContext& context) {
  const Rect& picture = context.layout.picture;
  const Plate plate("scene", context.layout.frame,
                    {Layer::kFixed, status_of(context.view).color, 0.0F});
  context.places.set("scene", picture);
  touch_area("picture", picture,
             ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight |
                 ImGuiButtonFlags_MouseButtonMiddle);
  handle_scene_input(context);
  draw_scene(context);
  add_repainted(context);
  context.pictures.scene.add(context.scene.picture(), picture);
  draw_distance_labels(context);
}

}  // namespace flytri::ui
