#include "ui/widgets/meter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace flytri::ui {

void meter(const Theme& theme, const Rect& box, double share, const Color& color,
           std::optional<double> mark) {
  const float rounding = box.height / 2.0F;
  draw_box(box, kRaised, rounding);
  const float filled = box.width * static_cast<float>(std::clamp(share, 0.0, 1.0));
  if (filled > 0.0F) {
    draw_box({box.x, box.y, std::max(filled, box.height), box.height}, color, rounding);
  }
  if (!mark) return;
  const float x = box.x + box.width * static_cast<float>(std::clamp(*mark, 0.0, 1.0));
  draw_box(
      {x - theme.px(1.0F), box.y - theme.px(3.0F), theme.px(2.0F), box.height + theme.px(6.0F)},
      kText);
}

void labeled_value(const Theme& theme, const Rect& row, std::string_view label,
                   std::string_view value) {
  Rect rest = row;
  const float width = text_width(theme.fonts.strong, value);
  draw_text(rest.take_right(width, theme.px(kGapS)), {theme.fonts.strong, kText, Align::kRight},
            value);
  draw_text(rest, {theme.fonts.body, kTextQuiet, Align::kLeft}, label);
}

std::string clock_text(double seconds) {
  const auto whole = static_cast<long>(std::max(seconds, 0.0));
  if (whole >= 3600) {
    return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
  }
  return fmt::format("{}:{:02}", whole / 60, whole % 60);
}

std::string size_text(std::uint64_t bytes) {
  const auto size = static_cast<double>(bytes);
  if (size < 1e3) return fmt::format("{} B", bytes);
  if (size < 1e6) return fmt::format("{:.0f} kB", size / 1e3);
  if (size < 1e9) return fmt::format("{:.1f} MB", size / 1e6);
  return fmt::format("{:.1f} GB", size / 1e9);
}

std::string length_text(double length_mm) {
  if (std::abs(length_mm) < 0.1) return fmt::format("{:.0f} \u00b5m", 1e3 * length_mm);
  return fmt::format("{:.2f} mm", length_mm);
}

std::string time_left_text(double seconds, const Texts& texts) {
  if (seconds < 0.0) return {};
  if (seconds < 5.0) return texts[Text::kFewSecondsLeft];
  if (seconds < 90.0) return texts.fill<Text::kSecondsLeft>(std::ceil(seconds / 5.0) * 5.0);
  return texts.fill<Text::kMinutesLeft>(std::ceil(seconds / 60.0));
}

}  // namespace flytri::ui
