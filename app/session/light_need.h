/// @file  Whether somebody needs the lights now.
#pragma once

#include "ui/state/app_view.h"

namespace flytri::session {

/// What the window knows of itself.
struct WindowUse {
  bool has_focus = true;
  bool shows_devices = false;  ///< its panel shows the images of the cameras
};

/// kNoFocus: they would be needed, but the settings want them dark without focus.
enum class LightNeed { kNeeded, kNotNeeded, kNoFocus };

/// Needed while the user scans, before the first scan (the preview helps to find the teeth), and
/// while the devices are shown. Not needed while the scan is paused, computed or finished.
[[nodiscard]] LightNeed light_need(const ui::AppView& view, const WindowUse& use);

}  // namespace flytri::session
