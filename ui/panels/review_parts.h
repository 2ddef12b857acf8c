/// @file  The parts of the panel that measures a finished model.
#pragma once

#include <cstddef>
#include <string>

#include "ui/panels/panel.h"

namespace flytri::ui {

// What the panel shows in a mode, below the buttons for the modes.
void draw_section(const PanelContext& context, Rect rest);
void draw_undercut(const PanelContext& context, Rect rest);
void draw_margins(const PanelContext& context, Rect rest);

/// A number that the user may remove.
struct RemovableRow {
  std::string id;  ///< of the button
  std::string label, value;
  Text hint;  ///< of the button
};
/// @return  whether it is to be removed
bool removable(const PanelContext& context, Rect& rest, const RemovableRow& row);
/// How many such rows fit.
[[nodiscard]] std::size_t removable_rows(const PanelContext& context, const Rect& rest);

/// One row with a label and a value.
void value_row(const PanelContext& context, Rect& rest, Text label, const std::string& value);
/// What failed, and why. Nothing for an empty reason. @return  whether something failed
bool failure_text(const PanelContext& context, Rect& rest, Text headline,
                  const std::string& reason);

}  // namespace flytri::ui
