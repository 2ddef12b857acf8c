/// @file  Finds the surface point under a pixel from the depth of the picture.
#pragma once

#include <optional>

#include "ui/scene/eye.h"
#include "ui/scene/model_picture.h"
#include "ui/scene/scene_renderer.h"

namespace flytri::ui {

/// The normal is that of a plane fitted to the neighboring pixels of similar depth.
[[nodiscard]] std::optional<Pick> pick_from_depth(const PictureTarget& picture, const Eye& eye,
                                                  double x_px, double y_px);

}  // namespace flytri::ui
