/// @file  Short messages that come and go at the lower right of the scene.
#include "ui/panels/toasts.h"

#include <algorithm>

#include "ui/imgui/releases.h"
#include "ui/panels/panels.h"
#include "ui/theme/icons.h"

namespace flytri::ui {
namespace {

constexpr std::size_t kMostToasts = 3;
constexpr float kToastWidth = 340.0F;

struct ToastLook {
  Color color;
  const char* icon;
};

ToastLook look_of(Severity severity) {
  switch (severity) {
    case Severity::kWarning:
      return {kCaution, icon::kWarning};
    case Severity::kError:
      return {kBad, icon::kWarning};
    case Severity::kInformation:
      break;
  }
  return {kNeutral, icon::kInformation};
}

/// One message with its lower edge at `bottom`. @return  its upper edge
float draw_toast(const PanelContext& context, const Notice& notice, float bottom, int number) {
  const Theme& theme = context.theme;
  const Rect& picture = context.layout.picture;
  const float width = context.px(kToastWidth), padding = context.px(kGapM);
  const float icon_width = context.px(24.0F);
  const float text_width_px = width - 2.0F * padding - icon_width;
  const float text_height = wrapped_height(theme.fonts.body, text_width_px, notice.text);
  const float height = text_height + 2.0F * padding;
  const Rect box = {picture.right() - context.px(kGapM) - width, bottom - height, width, height};
  const std::string id = "toast" + std::to_string(number);
  const Plate plate(id.c_str(), box, overlay(context.theme));
  const ToastLook look = look_of(notice.severity);
  draw_box({box.x, box.y, context.px(4.0F), box.height}, look.color, context.px(2.0F));
  Rect row = box.inset(padding);
  Rect icon_box = row.take_left(icon_width);
  draw_text(icon_box.take_top(font_size_px(*theme.fonts.body)), {theme.fonts.strong, look.color},
            look.icon);
  draw_wrapped(row, {theme.fonts.body, kText}, notice.text);
  return box.y;
}

}  // namespace

double toast_duration_s(Severity severity) {
  switch (severity) {
    case Severity::kError:
      return 12.0;
    case Severity::kWarning:
      return 8.0;
    case Severity::kInformation:
      break;
  }
  return 4.0;
}

void update_toasts(const AppView& view, WindowState& state) {
  for (const Notice& notice : view.notices) {
    if (notice.number <= state.latest_notice) continue;
    state.latest_notice = notice.number;
    state.toasts.push_back({notice, view.now_s});
  }
  std::erase_if(state.toasts, [&](const ShownNotice& shown) {
    return view.now_s - shown.since_s > toast_duration_s(shown.notice.severity);
  });
  if (state.toasts.size() > kMostToasts) {
    state.toasts.erase(state.toasts.begin(),
                       state.toasts.end() - static_cast<std::ptrdiff_t>(kMostToasts));
  }
}

void draw_toasts(const PanelContext& context) {
  float bottom = context.layout.picture.bottom() - context.px(kGapM);
  if (context.state.tool != Tool::kNone) bottom -= context.px(76.0F);
  bottom -= recording_card_height(context);
  int number = 0;
  for (auto shown = context.state.toasts.rbegin(); shown != context.state.toasts.rend(); ++shown) {
    bottom = draw_toast(context, shown->notice, bottom, number++) - context.px(kGapS);
  }
}

}  // namespace flytri::ui
