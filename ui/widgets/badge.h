/// @file  A short text on a colored plate, and the legend of colors.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "ui/widgets/draw.h"

namespace flytri::ui {

/// Where a badge begins.
struct BadgeLook {
  const char* icon = nullptr;
  std::string text;
  Color color = kNeutral;
};

/// Filled with its color, as high as `box`, as wide as its text. @return  its width
float badge(const Theme& theme, const Rect& box, const BadgeLook& look, ImFont* font);

/// One color and what it means.
struct LegendRow {
  Color color;
  std::string text;
  bool is_hollow = false;  ///< only an outline
};
/// One row each; returns the height.
float legend(const Theme& theme, const Rect& box, std::span<const LegendRow> rows);

/// A color scale with texts at its ends and in its middle.
struct ScaleLook {
  std::span<const Color> colors;
  std::string low, middle, high;
};
float color_scale(const Theme& theme, const Rect& box, const ScaleLook& look);

}  // namespace flytri::ui
