/// @file  The look of the window at one scale: type scale, spacing scale, fonts.
#pragma once

#include <imgui.h>

#include "core/base/result.h"

namespace flytri::ui {

/// Steps of the spacing scale, in units: pixels at 100 %.
inline constexpr float kGapXs = 4.0F;
inline constexpr float kGapS = 8.0F;
inline constexpr float kGapM = 16.0F;
inline constexpr float kGapL = 24.0F;
inline constexpr float kGapXl = 32.0F;
inline constexpr float kRounding = 8.0F;

/// One font for each text size: a bitmap font is sharp only at its own size.
struct Fonts {
  ImFont* small = nullptr;   ///< 13: captions, keys
  ImFont* body = nullptr;    ///< 16
  ImFont* strong = nullptr;  ///< 16, semi-bold: labels of buttons, values
  ImFont* title = nullptr;   ///< 22, semi-bold
  ImFont* status = nullptr;  ///< 30, bold: readable from two meters
  ImFont* icon = nullptr;    ///< 26: icons of the large buttons
};

/// Used by every panel.
struct Theme {
  float scale = 1.0F;
  Fonts fonts;

  /// Units to whole pixels, so that edges are sharp.
  [[nodiscard]] float px(float units) const;
};

/// The scale of all sizes: content_scale * user_scale, in steps of an eighth, 0.5 to 4. It is
/// larger in a large window, and smaller where the window would have less than 1024 x 640 units.
/// @param width_px, height_px  of the framebuffer
[[nodiscard]] float window_scale(double content_scale, double user_scale, int width_px,
                                 int height_px);

/// Replaces the fonts of the current ImGui context, and sets its style.
/// @errors  kNotFound names the font file and the Debian package that has it.
[[nodiscard]] Result<Theme> make_theme(float scale);

}  // namespace flytri::ui
