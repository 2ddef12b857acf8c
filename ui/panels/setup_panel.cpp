/// @file  Sets a sensor up: what was found, the question to the user, its answers.
#include <fmt/format.h>

#include <algorithm>

#include "ui/panels/dialog.h"
#include "ui/panels/panels.h"
#include "ui/theme/icons.h"

namespace flytri::ui {
namespace {

constexpr float kSetupChoice = 104.0F, kSetupChoiceButton = 264.0F;
constexpr float kSetupButtons = 48.0F, kAnswerRow = 48.0F;

void draw_way(const PanelContext& context, Rect row, Action action, const char* icon,
              Text purpose) {
  const Rect button = row.take_left(context.px(kSetupChoiceButton), context.px(kGapM));
  small_action(context, button.centered(button.width, context.px(56.0F)), action, {icon});
  const ActionState current = action_state(action, context.view, context.state);
  const std::string text = current.is_enabled
                               ? context.text(purpose)
                               : context.view.texts.fill<Text::kNotPossible>(current.text);
  const float height = wrapped_height(context.theme.fonts.body, row.width, text);
  draw_wrapped(row.centered(row.width, height), {context.theme.fonts.body, kTextQuiet}, text);
}

void draw_ways(const PanelContext& context) {
  DialogPlate dialog(context, context.text(Text::kSetUpSensor), {880.0F, 400.0F});
  const auto next_row = [&] {
    return dialog.rest.take_top(context.px(kSetupChoice), context.px(kGapS));
  };
  draw_way(context, next_row(), Action::kBeginSetup, icon::kDevice, Text::kSetupPurpose);
  draw_way(context, next_row(), Action::kVirtualSensor, icon::kTarget, Text::kVirtualSensorPurpose);
  draw_wrapped(dialog.rest, {context.theme.fonts.small, kTextQuiet},
               context.text(Text::kSetupIsKept));
}

/// Lines of text in one font.
struct Paragraph {
  ImFont* font;
  Color color;
  std::string text;
};

float height_of(const PanelContext& context, const Rect& box, const Paragraph& paragraph) {
  if (paragraph.text.empty()) return 0.0F;
  return wrapped_height(paragraph.font, box.width, paragraph.text) + context.px(kGapS);
}

void draw_paragraph(const PanelContext& context, Rect& rest, const Paragraph& paragraph) {
  draw_wrapped(rest.take_top(height_of(context, rest, paragraph)),
               {paragraph.font, paragraph.color}, paragraph.text);
}

/// What setup told; the earliest gives way. @param kept_px  height to leave below
void draw_told(const PanelContext& context, Rect& rest, const std::vector<std::string>& told,
               float kept_px) {
  const auto paragraph = [&](std::size_t i) {
    return Paragraph{context.theme.fonts.body, kTextQuiet, told[i]};
  };
  std::size_t first = told.size();
  for (float free_px = rest.height - kept_px; first > 0; --first) {
    free_px -= height_of(context, rest, paragraph(first - 1));
    if (free_px < 0.0F) break;
  }
  for (std::size_t i = first; i < told.size(); ++i) draw_paragraph(context, rest, paragraph(i));
}

float answers_height(const PanelContext& context, const RunningSetup& running) {
  if (running.step != SetupStep::kAsking) return 0.0F;
  const auto count = static_cast<float>(running.question.answers.size());
  return count * context.px(kAnswerRow + kGapXs);
}

void draw_answers(const PanelContext& context, Rect rest, const SetupQuestion& question) {
  for (std::size_t i = 0; i < question.answers.size(); ++i) {
    const std::string id = fmt::format("answer_{}", i);
    const Rect box = rest.take_top(context.px(kAnswerRow), context.px(kGapXs));
    ButtonLook look;
    look.id = id.c_str();
    look.label = question.answers[i];
    look.is_main = i == question.suggested;
    if (look.is_main) look.key = context.text(Text::kKeyEnter);
    context.places.set(id, box);
    if (small_button(context.theme, box, look))
      context.commands.emplace_back(AnswerSetup{question.number, i});
  }
}

Paragraph setup_headline(const PanelContext& context, const RunningSetup& running) {
  ImFont* font = context.theme.fonts.title;
  switch (running.step) {
    case SetupStep::kAsking:
      return {font, kText, running.question.text};
    case SetupStep::kDone:
      return {font, kGood, context.text(Text::kSensorIsSetUp)};
    case SetupStep::kFailed:
      return {font, kBad, context.text(Text::kSetupStopped)};
    case SetupStep::kWorking:
      break;
  }
  return {font, kText, context.text(Text::kSettingUp)};
}

void draw_setup_buttons(const PanelContext& context, Rect row, const RunningSetup& running) {
  const bool has_ended = running.step == SetupStep::kDone || running.step == SetupStep::kFailed;
  const ActionLook stop = {icon::kCancel, context.text(has_ended ? Text::kClose : Text::kStop)};
  small_action(context, row.take_left(small_action_width(context, Action::kCancel, stop)),
               Action::kCancel, stop);
  if (running.step != SetupStep::kDone) return;
  const ActionLook use = {icon::kSaved, context.text(Text::kUseSensor), true, kNeutral};
  small_action(
      context,
      row.take_right(small_action_width(context, Action::kConfirm, use), context.px(kGapM)),
      Action::kConfirm, use);
  const std::string& why = context.view.setup.why_not_used;
  draw_text(row, {context.theme.fonts.small, kTextQuiet, Align::kRight},
            why.empty() ? context.view.texts.fill<Text::kSavedIn>(running.file) : why);
}

void draw_running_setup(const PanelContext& context, const RunningSetup& running) {
  DialogPlate dialog(context, context.text(Text::kSetUpSensor), {1000.0F, 752.0F},
                     ClickBeside::kNothing);
  Rect rest = dialog.rest;
  draw_setup_buttons(context, rest.take_bottom(context.px(kSetupButtons), context.px(kGapM)),
                     running);
  const Paragraph headline = setup_headline(context, running);
  const Paragraph why = {context.theme.fonts.body, kText, sentence(running.message)};
  const float kept_px = height_of(context, rest, headline) + height_of(context, rest, why) +
                        answers_height(context, running);
  draw_told(context, rest, running.told, kept_px);
  draw_paragraph(context, rest, headline);
  if (!why.text.empty()) draw_paragraph(context, rest, why);
  if (running.step == SetupStep::kAsking) draw_answers(context, rest, running.question);
}

}  // namespace

void draw_setup_panel(const PanelContext& context) {
  const auto& running = context.view.setup.running;
  if (running) return draw_running_setup(context, *running);
  draw_ways(context);
}

}  // namespace flytri::ui
