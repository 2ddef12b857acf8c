/// @file  The neutral colors of the window: surfaces, lines and text. Colors with a meaning are in
/// status_colors.h.
#pragma once

#include <imgui.h>

#include "ui/theme/status_colors.h"

namespace flytri::ui {

inline constexpr Color kBackground = {0.063F, 0.075F, 0.086F, 1.0F};  ///< behind everything
inline constexpr Color kPanel = {0.102F, 0.118F, 0.133F, 1.0F};       ///< bars and panels
inline constexpr Color kRaised = {0.161F, 0.184F, 0.208F, 1.0F};      ///< buttons, fields
inline constexpr Color kRaisedHover = {0.212F, 0.243F, 0.275F, 1.0F};
inline constexpr Color kRaisedActive = {0.267F, 0.306F, 0.345F, 1.0F};
inline constexpr Color kHairline = {0.235F, 0.267F, 0.298F, 1.0F};
inline constexpr Color kText = {0.957F, 0.965F, 0.969F, 1.0F};
/// Contrast above 4.5 on kPanel and kRaised, as WCAG asks for small text.
inline constexpr Color kTextQuiet = {0.698F, 0.741F, 0.776F, 1.0F};
inline constexpr Color kTextOnColor = {0.031F, 0.043F, 0.051F, 1.0F};  ///< on status colors
inline constexpr Color kShade = {0.0F, 0.0F, 0.0F, 0.62F};             ///< behind dialogs

[[nodiscard]] constexpr Color with_opacity(const Color& color, float opacity) {
  return {color[0], color[1], color[2], color[3] * opacity};
}
/// Between a at 0 and b at 1.
[[nodiscard]] constexpr Color mix(const Color& a, const Color& b, float share) {
  Color mixed{};
  for (std::size_t i = 0; i < mixed.size(); ++i) mixed[i] = a[i] + share * (b[i] - a[i]);
  return mixed;
}
[[nodiscard]] inline ImVec4 to_vec4(const Color& c) { return {c[0], c[1], c[2], c[3]}; }
[[nodiscard]] inline ImU32 to_u32(const Color& c) {
  return ImGui::ColorConvertFloat4ToU32(to_vec4(c));
}

}  // namespace flytri::ui
