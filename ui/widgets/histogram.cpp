#include "ui/widgets/histogram.h"

#include <cmath>

#include "ui/theme/status_colors.h"

namespace flytri::ui {
namespace {

/// Lines cover few pixels: a share of 1e-5 is still visible.
constexpr double kLeastShare = 1e-5;

/// Height of a bar on the logarithmic scale: 0..1.
float height_of(double share) {
  if (share <= kLeastShare) return 0.0F;
  return static_cast<float>(1.0 - std::log10(share) / std::log10(kLeastShare));
}

}  // namespace

void histogram(const Theme& theme, const Rect& box, std::span<const double> shares) {
  draw_box(box, kBackground, theme.px(kGapXs));
  Rect rest = box.inset(theme.px(kGapXs));
  const float width = rest.width / static_cast<float>(shares.size());
  for (std::size_t i = 0; i < shares.size(); ++i) {
    const float left = std::round(rest.x + width * static_cast<float>(i));
    const float right = std::round(rest.x + width * static_cast<float>(i + 1));
    const float height = std::round(rest.height * height_of(shares[i]));
    const bool is_clipped = i + 1 == shares.size();
    draw_box({left, rest.bottom() - height, right - left, height}, is_clipped ? kBad : kTextQuiet);
  }
}

}  // namespace flytri::ui
