/// @file  Which place of the surface lies under a pixel, from the picture's depth.
#pragma once

#include <optional>

#include "ui/scene/eye.h"
#include "ui/scene/model_picture.h"
#include "ui/scene/scene_renderer.h"

namespace flytri::ui {

/// The normal is that of the plane through the places of the pixels around that lie about as deep.
[[nodiscard]] std::optional<Pick> pick_from_depth(const PictureTarget& picture, const Eye& eye,
                                                  double x_px, double y_px);

}  // namespace flytri::ui
