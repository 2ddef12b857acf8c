/// @file  The input of every panel, and the plate (a plain window) on which it draws.
#pragma once

#include <array>
#include <vector>

#include "ui/actions/action_table.h"
#include "ui/panels/layout.h"
#include "ui/panels/scene_image.h"
#include "ui/scene/scene_renderer.h"
#include "ui/widgets/button.h"
#include "ui/widgets/camera_image.h"
#include "ui/widgets/exposed_picture.h"
#include "ui/widgets/item_places.h"

namespace flytri::ui {

/// Images of the window in graphics memory.
struct Pictures {
  CameraPicture live, stored;
  CameraPicture target;                   ///< of the calibration panel
  std::array<ExposedPicture, 3> exposed;  ///< vertical, horizontal, flash: of the device panel
  SceneImage scene;
};

/// Input and output of all panels in one frame. They read the view and add commands.
struct PanelContext {
  const AppView& view;
  WindowState& state;
  std::vector<Command>& commands;
  const Theme& theme;
  const Layout& layout;
  SceneRenderer& scene;
  Pictures& pictures;
  ItemPlaces& places;
  std::vector<Rect>& repainted;  ///< where textures on the screen changed

  [[nodiscard]] float px(float units) const { return theme.px(units); }
  [[nodiscard]] const char* text(Text key) const { return view.texts[key]; }
  [[nodiscard]] scan::ScanPhase phase() const {
    return view.scan == nullptr ? scan::ScanPhase::kPreview : view.scan->phase;
  }
};

/// Order of plates: fixed parts at the bottom, overlays of the scene above, a dialog on top.
enum class Layer { kFixed, kOver, kDialog };

/// The look of a plate. A transparent one is invisible but takes clicks.
struct PlateLook {
  Layer layer = Layer::kFixed;
  Color color = kPanel;
  float rounding_px = 0.0F;
};

/// While it exists, a window of Dear ImGui without decoration at a fixed place.
class Plate {
 public:
  Plate(const char* id, const Rect& box, const PlateLook& look = {});
  ~Plate();
  Plate(const Plate&) = delete;
  Plate& operator=(const Plate&) = delete;
};

/// For plates over the scene: slightly transparent.
[[nodiscard]] PlateLook overlay(const Theme& theme);

/// A camera image in a box, see widgets/camera_image.h.
/// @return  where the image lies
Rect show_camera_image(const PanelContext& context, const Rect& box, const CameraPicture& picture,
                       const char* missing_text);

/// The look of an action's button; the rest comes from the table of actions.
struct ActionLook {
  const char* icon = nullptr;
  const char* label = nullptr;  ///< null: the name in the table of actions
  bool is_main = false;
  Color color = kNeutral;
  bool shows_key = true;
};

/// Buttons that do the same as the key of the action.
void large_action(const PanelContext& context, const Rect& box, Action action,
                  const ActionLook& look);
void small_action(const PanelContext& context, const Rect& box, Action action,
                  const ActionLook& look);
[[nodiscard]] float small_action_width(const PanelContext& context, Action action,
                                       const ActionLook& look);

}  // namespace flytri::ui
