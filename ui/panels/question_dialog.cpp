/// @file  A question before something is lost.
#include "ui/panels/dialog.h"
#include "ui/panels/panels.h"
#include "ui/state/question.h"
#include "ui/theme/icons.h"

namespace flytri::ui {
namespace {

constexpr float kQuestionWidth = 560.0F, kQuestionButtons = 48.0F;
constexpr float kQuestionFrame = 2.0F * kGapL + 32.0F + 2.0F * kGapM + kQuestionButtons;

}  // namespace

void draw_question_dialog(const PanelContext& context) {
  const Question& question = context.state.question;
  const QuestionWords words = words_of(question, context.view);
  const Fonts& fonts = context.theme.fonts;
  const float text =
      wrapped_height(fonts.body, context.px(kQuestionWidth - 2.0F * kGapL), words.text);
  DialogPlate dialog(context, words.title.c_str(),
                     {kQuestionWidth, kQuestionFrame + text / context.theme.scale});
  Rect left = confirm_row(context, dialog, icon::kWarning, words.confirm.c_str());
  const bool offers_kept = question.kind == QuestionKind::kClearStage && context.view.has_kept_scan;
  if (offers_kept) {
    const ActionLook look = {icon::kUndo, context.text(Text::kBringBack)};
    const float width = small_action_width(context, Action::kBringBack, look);
    small_action(context, left.take_left(width, context.px(kGapS)), Action::kBringBack, look);
  } else {
    const ActionLook look = {icon::kCancel, context.text(Text::kCancel)};
    const float width = small_action_width(context, Action::kCancel, look);
    small_action(context, left.take_left(width, context.px(kGapS)), Action::kCancel, look);
  }
  draw_wrapped(dialog.rest, {fonts.body, kText}, words.text);
}

}  // namespace flytri::ui
