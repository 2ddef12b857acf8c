/// @file  What was drawn, as a PNG file.
#pragma once

#include <string>

#include "core/base/result.h"
#include "core/imaging/frame.h"

namespace flytri::ui {

/// Reads the framebuffer that is being drawn into; before it is shown.
/// @errors  those of writing a PNG.
[[nodiscard]] Result<void> save_screenshot(const ImageSize& size, const std::string& path);

}  // namespace flytri::ui
