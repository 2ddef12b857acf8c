/// @file  The frame of a dialog, and the rows of its forms.
#pragma once

#include <string>

#include "core/base/secret.h"
#include "ui/panels/panel.h"

namespace flytri::ui {

/// What a click beside the dialog does. kNothing: closing it would lose work.
enum class ClickBeside { kCloses, kNothing };

/// Darkens the window and opens a dialog in its middle.
class DialogPlate {
 public:
  /// @param size  in units; cut to the window
  DialogPlate(const PanelContext& context, const char* title, const ImVec2& size,
              ClickBeside beside = ClickBeside::kCloses);

  /// The free area below the title; dialogs cut it up.
  Rect rest;

 private:
  Plate plate_;
};

struct TextFieldLook {
  const char* id = "";
  const char* label = "";
  bool takes_focus = false;  ///< in this frame
};
inline constexpr float kFieldRow = 68.0F;  ///< height with the label, in units

/// @return  true when the text was changed
bool text_field(const PanelContext& context, Rect row, const TextFieldLook& look,
                std::string& text);
/// Shows dots.
bool text_field(const PanelContext& context, Rect row, const TextFieldLook& look, Secret& text);

/// A text field for a path, with a button that opens the desktop's file chooser.
bool path_field(const PanelContext& context, Rect row, const TextFieldLook& look, PathField field,
                std::string& text);

struct TickLook {
  const char* id = "";
  std::string label;
  bool is_enabled = true;
};
/// Wide enough for a gloved finger. @return  true when it was changed
bool tick_box(const PanelContext& context, const Rect& row, const TickLook& look, bool& is_ticked);

/// The button that confirms, at the lower right.
/// @return  what is free on its left
Rect confirm_row(const PanelContext& context, DialogPlate& dialog, const char* icon,
                 const char* label);

}  // namespace flytri::ui
