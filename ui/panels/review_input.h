/// @file  What clicks on a finished model measure.
#pragma once

#include "ui/panels/panel.h"

namespace flytri::ui {

/// Handles the left button on the scene while the tool for measuring is in hand on a finished
/// model. Call it after the item of the scene; the surface under the pointer is known.
void handle_review_input(const PanelContext& context);

/// Asks for the undercut around the clicked tooth.
/// @param axis  none: the one with the least undercut
void ask_for_undercut(const PanelContext& context, const std::optional<Vec3>& axis);

}  // namespace flytri::ui
