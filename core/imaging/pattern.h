/// @file  The two crossed line patterns, and the image axis along each.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace flytri {

/// "Vertical" lines run along image columns and are localized in every row; "horizontal" lines run
/// along image rows and are localized in every column.
enum class Pattern { kVertical, kHorizontal };

inline constexpr std::array kPatterns = {Pattern::kVertical, Pattern::kHorizontal};

/// A set of patterns, one bit each.
using PatternSet = std::uint8_t;

[[nodiscard]] constexpr PatternSet set_of(Pattern pattern) {
  return pattern == Pattern::kVertical ? 1 : 2;
}

[[nodiscard]] constexpr Pattern other(Pattern pattern) {
  return pattern == Pattern::kVertical ? Pattern::kHorizontal : Pattern::kVertical;
}

[[nodiscard]] constexpr std::string_view to_string(Pattern pattern) {
  return pattern == Pattern::kVertical ? "vertical" : "horizontal";
}

/// A pixel in coordinates of a line: `along` is the row (vertical pattern) or column (horizontal
/// pattern), `across` the position of the line in that row or column.
struct LinePixel {
  double along_px = 0.0;
  double across_px = 0.0;
};

/// An image position: u runs right, v down, (0, 0) is the center of the top-left pixel.
struct Pixel {
  double u_px = 0.0;
  double v_px = 0.0;
};

[[nodiscard]] constexpr Pixel to_pixel(Pattern pattern, const LinePixel& p) {
  return pattern == Pattern::kVertical ? Pixel{p.across_px, p.along_px}
                                       : Pixel{p.along_px, p.across_px};
}

[[nodiscard]] constexpr LinePixel to_line_pixel(Pattern pattern, const Pixel& p) {
  return pattern == Pattern::kVertical ? LinePixel{p.v_px, p.u_px} : LinePixel{p.u_px, p.v_px};
}

}  // namespace flytri
