/// @file  The latest views of both patterns in the box of the measurement volume, small.
#pragma once

#include <array>
#include <memory>

#include "core/geometry/view.h"
#include "ui/widgets/draw.h"

namespace flytri::ui {

/// Where a point of the sensor frame lies in the box: an oblique look onto the volume, x right,
/// y down, deeper to the upper right.
[[nodiscard]] ImVec2 place_in_preview(const Rect& box, const Vec3& volume_mm, const Vec3& point_mm);

/// @param views  by Pattern; null where there is none
void volume_preview(const Theme& theme, const Rect& box, const Vec3& volume_mm,
                    const std::array<std::shared_ptr<const View>, 2>& views);

}  // namespace flytri::ui
