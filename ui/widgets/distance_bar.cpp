#include "ui/widgets/distance_bar.h"

#include <algorithm>

namespace flytri::ui {
namespace {

/// Position of a depth share on the bar: -1 at the left end, 1 at the right.
float place_along(const Rect& bar, double depth_share) {
  const auto share = static_cast<float>(std::clamp(depth_share, -1.0, 1.0));
  return bar.x + bar.width * (share + 1.0F) / 2.0F;
}

void draw_zones(const Theme& theme, const Rect& bar) {
  const float low = place_along(bar, -kGoodDepthShare), high = place_along(bar, kGoodDepthShare);
  const float gap = theme.px(2.0F), rounding = theme.px(4.0F);
  draw_box({bar.x, bar.y, low - gap - bar.x, bar.height}, with_opacity(kBad, 0.75F), rounding);
  draw_box({low, bar.y, high - low, bar.height}, with_opacity(kGood, 0.85F), rounding);
  draw_box({high + gap, bar.y, bar.right() - high - gap, bar.height}, with_opacity(kBad, 0.75F),
           rounding);
}

void draw_marker(const Theme& theme, const Rect& bar, double depth_share) {
  const float x = place_along(bar, depth_share);
  const float half = theme.px(5.0F), over = theme.px(5.0F);
  const Rect marker = {x - half, bar.y - over, 2.0F * half, bar.height + 2.0F * over};
  draw_box(marker, kText, half);
  draw_outline(marker, kPanel, theme.px(2.0F), half);
}

Text words_for(DistanceVerdict verdict) {
  switch (verdict) {
    case DistanceVerdict::kTooNear:
      return Text::kTooNear;
    case DistanceVerdict::kTooFar:
      return Text::kTooFar;
    case DistanceVerdict::kFine:
      break;
  }
  return Text::kDistanceGood;
}

void draw_verdict(const Theme& theme, const Rect& row,
                  const std::optional<scan::SensorDistance>& distance, const Texts& texts) {
  draw_text(row, {theme.fonts.body, kTextQuiet, Align::kLeft}, texts[Text::kDistance]);
  const TextStyle value = {theme.fonts.strong, distance ? kText : kTextQuiet, Align::kRight};
  draw_text(
      row, value,
      texts[distance ? words_for(judge_distance(distance->depth_share)) : Text::kNoSurfaceInView]);
}

void draw_ends(const Theme& theme, const Rect& row, const Texts& texts) {
  draw_text(row, {theme.fonts.small, kTextQuiet, Align::kLeft}, texts[Text::kTooNear]);
  draw_text(row, {theme.fonts.small, kTextQuiet, Align::kCenter}, texts[Text::kDistanceGood]);
  draw_text(row, {theme.fonts.small, kTextQuiet, Align::kRight}, texts[Text::kTooFar]);
}

}  // namespace

DistanceVerdict judge_distance(double depth_share) {
  if (depth_share < -kGoodDepthShare) return DistanceVerdict::kTooNear;
  return depth_share > kGoodDepthShare ? DistanceVerdict::kTooFar : DistanceVerdict::kFine;
}

void distance_bar(const Theme& theme, const Rect& box,
                  const std::optional<scan::SensorDistance>& distance, const Texts& texts) {
  Rect rest = box;
  draw_verdict(theme, rest.take_top(theme.px(20.0F), theme.px(10.0F)), distance, texts);
  const Rect bar = rest.take_top(theme.px(16.0F), theme.px(kGapS));
  if (distance) {
    draw_zones(theme, bar);
    draw_marker(theme, bar, distance->depth_share);
  } else {
    draw_box(bar, kRaised, theme.px(4.0F));
  }
  draw_ends(theme, rest.take_top(theme.px(16.0F)), texts);
}

}  // namespace flytri::ui
