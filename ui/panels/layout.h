/// @file  Layout of the window: size and scale in, rectangles out.
#pragma once

#include "ui/theme/theme.h"
#include "ui/widgets/rect.h"

namespace flytri::ui {

/// Height of the status banner, in units.
inline constexpr float kBannerHeight = 52.0F;

/// The fixed parts of the window. They touch, do not overlap, and fill it.
struct Layout {
  Rect window;
  Rect top;      ///< case, stage, figures
  Rect bottom;   ///< the large buttons
  Rect side;     ///< live image, distance
  Rect frame;    ///< the status color around the scene
  Rect picture;  ///< the scene within the frame
};

/// All in whole pixels. @param theme  only its scale is used
[[nodiscard]] Layout make_layout(float width_px, float height_px, const Theme& theme);

}  // namespace flytri::ui
