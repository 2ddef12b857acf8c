/// @file  Whether the occlusal plane is shown.
#pragma once

#include <optional>

#include "ui/state/app_view.h"
#include "ui/state/window_state.h"

namespace flytri::ui {

/// While its tool is in use and the plane is known.
[[nodiscard]] inline std::optional<OcclusalPlane> shown_plane(const AppView& view,
                                                              const WindowState& state) {
  return state.tool == Tool::kPlane ? view.plane : std::nullopt;
}

}  // namespace flytri::ui
