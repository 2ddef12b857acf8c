#include "ui/panels/device_cards.h"

#include <fmt/format.h>

#include <algorithm>

#include "ui/theme/icons.h"

namespace flytri::ui {
namespace {

constexpr float kCard = 76.0F;
constexpr float kCardHead = 24.0F;
constexpr float kDot = 10.0F;
constexpr float kCheckHeading = 36.0F;
constexpr float kMoreRow = 24.0F;
constexpr float kFocusRow = 36.0F, kFocusButton = 96.0F;
constexpr std::size_t kMostFigures = 7;

Color color_of(DeviceHealth health) {
  switch (health) {
    case DeviceHealth::kFine:
      return kGood;
    case DeviceHealth::kDoubtful:
      return kCaution;
    case DeviceHealth::kBroken:
      return kBad;
    case DeviceHealth::kUnknown:
      break;
  }
  return kTextQuiet;
}

void draw_head(const PanelContext& context, Rect row, const DeviceState& device) {
  const Theme& theme = context.theme;
  const float dot = context.px(kDot);
  draw_box(row.take_left(dot, context.px(kGapS)).centered(dot, dot), color_of(device.health),
           dot / 2.0F);
  draw_text(row.take_right(text_width(theme.fonts.strong, device.state), context.px(kGapS)),
            {theme.fonts.strong, color_of(device.health), Align::kRight}, device.state);
  draw_text(row.take_left(text_width(theme.fonts.strong, device.role) + 1.0F, context.px(kGapS)),
            {theme.fonts.strong, kText, Align::kLeft}, device.role);
  draw_text(row, {theme.fonts.body, kTextQuiet, Align::kLeft}, device.name);
}

void draw_figures(const PanelContext& context, Rect row, const std::vector<DeviceFigure>& figures) {
  const Theme& theme = context.theme;
  const float width = row.width / static_cast<float>(kMostFigures);
  for (std::size_t i = 0; i < std::min(figures.size(), kMostFigures); ++i) {
    Rect cell = row.take_left(width);
    cell.width -= context.px(kGapXs);
    ImFont* font =
        fitting_font({theme.fonts.strong, theme.fonts.small}, cell.width, figures[i].value);
    draw_text(cell.take_top(cell.height / 2.0F),
              {font, figures[i].is_worrying ? kCaution : kText, Align::kLeft}, figures[i].value);
    draw_text(cell, {theme.fonts.small, kTextQuiet, Align::kLeft}, figures[i].label);
  }
}

/// @param kept_px  height to leave for the next rows
/// @return  false: not drawn, as it does not fit; half a remedy would mislead
bool draw_problem(const PanelContext& context, Rect& rest, const std::string& problem,
                  float kept_px) {
  ImFont* font = context.theme.fonts.body;
  Rect text = rest;
  Rect margin = text.take_left(context.px(20.0F), context.px(kGapXs));
  const float height = wrapped_height(font, text.width, problem);
  if (height > rest.height - kept_px) return false;
  draw_text(margin.take_top(context.px(20.0F)), {font, kCaution, Align::kLeft}, icon::kWarning);
  draw_wrapped(text, {font, kText}, problem);
  rest.take_top(height, context.px(kGapS));
  return true;
}

/// Shown instead of a list of problems.
Text verdict_on(const DevicesState& devices) {
  if (devices.is_checking) return Text::kCheckingDevices;
  return devices.is_checked ? Text::kNoProblemsFound : Text::kNotCheckedYet;
}

void draw_focus_setting(const PanelContext& context, Rect row) {
  const bool is_on = context.view.settings.is_dark_without_focus;
  ButtonLook look;
  look.id = "dark_without_focus";
  look.label = context.text(is_on ? Text::kButtonOn : Text::kButtonOff);
  look.is_on = is_on;
  const Rect button = row.take_right(context.px(kFocusButton), context.px(kGapS));
  context.places.set(look.id, button);
  draw_text(row, {context.theme.fonts.body, kText, Align::kLeft},
            context.text(Text::kDarkWithoutFocus));
  if (!small_button(context.theme, button, look)) return;
  Settings settings = context.view.settings;
  settings.is_dark_without_focus = !is_on;
  context.commands.emplace_back(ChangeSettings{settings});
}

void draw_verdict(const PanelContext& context, Rect row, const DevicesState& devices) {
  const bool is_good = devices.is_checked && !devices.is_checking;
  if (is_good) {
    draw_text(row.take_left(context.px(24.0F), context.px(kGapXs)),
              {context.theme.fonts.strong, kGood, Align::kLeft}, icon::kSaved);
  }
  draw_text(row, {context.theme.fonts.body, kTextQuiet, Align::kLeft},
            context.text(verdict_on(devices)));
}

}  // namespace

void draw_device_cards(const PanelContext& context, Rect box) {
  for (const DeviceState& device : context.view.devices->devices) {
    const Rect card = box.take_top(context.px(kCard), context.px(kGapXs));
    draw_box(card, kRaised, context.px(kRounding));
    Rect inner = card.inset(context.px(12.0F), context.px(6.0F));
    draw_head(context, inner.take_top(context.px(kCardHead), context.px(2.0F)), device);
    draw_figures(context, inner, device.figures);
  }
}

void draw_device_check(const PanelContext& context, Rect box) {
  const DevicesState& devices = *context.view.devices;
  const Theme& theme = context.theme;
  draw_focus_setting(context, box.take_bottom(context.px(kFocusRow), context.px(kGapS)));
  Rect head = box.take_top(context.px(kCheckHeading), context.px(kGapS));
  const ActionLook look = {icon::kResume, context.text(Text::kCheckAgain)};
  small_action(context, head.take_right(small_action_width(context, Action::kCheckDevices, look)),
               Action::kCheckDevices, look);
  draw_text(head, {theme.fonts.strong, kNeutral, Align::kLeft}, context.text(Text::kProblems));
  if (devices.problems.empty()) {
    return draw_verdict(context, box.take_top(context.px(24.0F)), devices);
  }
  const std::size_t count = devices.problems.size();
  for (std::size_t i = 0; i < count; ++i) {
    const float kept_px = i + 1 < count ? context.px(kMoreRow) : 0.0F;
    if (draw_problem(context, box, sentence(devices.problems[i]), kept_px)) continue;
    draw_text(box.take_top(context.px(kMoreRow)), {theme.fonts.body, kTextQuiet, Align::kLeft},
              context.view.texts.fill<Text::kMoreProblems>(count - i));
    return;
  }
}

}  // namespace flytri::ui
