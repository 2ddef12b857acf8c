/// @file  The status of the scan, in large letters at the top of the colored frame.
#include <cmath>

#include "ui/panels/panels.h"
#include "ui/panels/status.h"
#include "ui/widgets/badge.h"

namespace flytri::ui {

void draw_status_banner(const PanelContext& context) {
  const Status status = status_of(context.view);
  const Theme& theme = context.theme;
  const float height = context.px(kBannerHeight);
  const float hint_gap = context.px(kGapM);
  const float text = text_width(theme.fonts.status, status.text) +
                     text_width(theme.fonts.status, status.icon) + context.px(kGapS);
  const float hint =
      status.hint.empty() ? 0.0F : hint_gap + text_width(theme.fonts.title, status.hint);
  const float width =
      std::min(text + hint + 2.0F * context.px(kGapL), context.layout.picture.width);
  const Rect box = {std::round(context.layout.frame.center().x - width / 2.0F),
                    context.layout.frame.y, std::round(width), height};
  const Plate plate("banner", box, {Layer::kOver, with_opacity(status.color, 0.0F), 0.0F});
  ImGui::GetWindowDrawList()->AddRectFilled(box.min(), box.max(), to_u32(status.color),
                                            context.px(12.0F), ImDrawFlags_RoundCornersBottom);
  Rect row = box.inset(context.px(kGapL), context.px(kGapS));
  row.width += 2.0F;  // Rounding must not cut the hint short.
  const float icon_width = text_width(theme.fonts.status, status.icon);
  draw_text(row.take_left(icon_width, context.px(kGapS)), {theme.fonts.status, kTextOnColor},
            status.icon);
  const float word = text_width(theme.fonts.status, status.text) + 1.0F;
  draw_text(row.take_left(word, hint_gap), {theme.fonts.status, kTextOnColor}, status.text);
  // Messages of devices may be long.
  draw_fitted(row, {theme.fonts.title, theme.fonts.strong, theme.fonts.small}, kTextOnColor,
              status.hint);
}

}  // namespace flytri::ui
