/// @file  A small picture of the latest views of both patterns in the measurement volume.
#pragma once

#include <array>
#include <memory>

#include "core/geometry/view.h"
#include "ui/widgets/draw.h"

namespace flytri::ui {

/// Position of a point of the sensor frame in the box. Oblique projection: x right, y down, depth
/// to the upper right.
[[nodiscard]] ImVec2 place_in_preview(const Rect& box, const Vec3& volume_mm, const Vec3& point_mm);

/// @param views  by Pattern; null if there is none
void volume_preview(const Theme& theme, const Rect& box, const Vec3& volume_mm,
                    const std::array<std::shared_ptr<const View>, 2>& views);

}  // namespace flytri::ui
