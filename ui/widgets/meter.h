/// @file  A bar for progress or a match, and texts of numbers with units.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "ui/text/texts.h"
#include "ui/widgets/draw.h"

namespace flytri::ui {

/// @param share  0..1 of the bar
/// @param mark   the goal, drawn as a line at this share
void meter(const Theme& theme, const Rect& box, double share, const Color& color,
           std::optional<double> mark = std::nullopt);

/// A label on the left, a value on the right, in one row.
void labeled_value(const Theme& theme, const Rect& row, std::string_view label,
                   std::string_view value);

/// Seconds as a clock: 65 is "1:05".
[[nodiscard]] std::string clock_text(double seconds);
/// Bytes in a suitable unit: 1'234'567 is "1.2 MB".
[[nodiscard]] std::string size_text(std::uint64_t bytes);
/// Lengths below a tenth of a millimeter in micrometers: 0.012 is "12 µm".
[[nodiscard]] std::string length_text(double length_mm);
/// "about 2 min left", "a few seconds left", "" if unknown (negative).
[[nodiscard]] std::string time_left_text(double seconds, const Texts& texts);

}  // namespace flytri::ui
