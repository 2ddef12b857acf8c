/// @file  Calibration at the chair: what to put where, the live image, and what to correct.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "ui/panels/calibration_cards.h"
#include "ui/panels/calibration_history.h"
#include "ui/panels/dialog.h"
#include "ui/panels/panels.h"
#include "ui/theme/icons.h"
#include "ui/widgets/meter.h"

namespace flytri::ui {
namespace {

constexpr float kChoiceRow = 76.0F;
constexpr float kChoiceButton = 264.0F;
constexpr float kButtonRow = 48.0F;
constexpr float kImageShare = 0.48F;

Text title_of(CalibrationTask task) {
  switch (task) {
    case CalibrationTask::kCheckOnPlane:
      return Text::kCheckOnPlane;
    case CalibrationTask::kCheckOnSphere:
      return Text::kCheckOnSphere;
    case CalibrationTask::kCalibrate:
      break;
  }
  return Text::kCalibratingTheSensor;
}

struct Choice {
  Action action;
  const char* icon;
  Text label;
  Text purpose;
};
constexpr std::array<Choice, 3> kChoices = {
    {{Action::kCalibrate, icon::kTarget, Text::kCalibrate, Text::kCalibratePurpose},
     {Action::kCheckOnPlane, icon::kFinish, Text::kCheckOnPlane, Text::kCheckOnPlanePurpose},
     {Action::kCheckOnSphere, icon::kFinish, Text::kCheckOnSphere, Text::kCheckOnSpherePurpose}}};

void draw_choice(const PanelContext& context, Rect row, const Choice& choice) {
  const Rect button = row.take_left(context.px(kChoiceButton), context.px(kGapM));
  small_action(context, button.centered(button.width, context.px(56.0F)), choice.action,
               {choice.icon, context.text(choice.label)});
  const ActionState current = action_state(choice.action, context.view, context.state);
  const std::string text = current.is_enabled
                               ? context.text(choice.purpose)
                               : context.view.texts.fill<Text::kNotPossible>(current.text);
  const float height = wrapped_height(context.theme.fonts.body, row.width, text);
  draw_wrapped(row.centered(row.width, height), {context.theme.fonts.body, kTextQuiet}, text);
}

void draw_choices(const PanelContext& context) {
  CalibrationForm& form = context.state.calibration_form;
  if (!form.is_edited) form.folder = context.view.calibration->folder;
  DialogPlate dialog(context, context.text(Text::kCalibration), {880.0F, 696.0F});
  for (const Choice& choice : kChoices) {
    draw_choice(context, dialog.rest.take_top(context.px(kChoiceRow), context.px(kGapS)), choice);
  }
  dialog.rest.take_top(context.px(kGapS));
  Rect fields = dialog.rest.take_top(context.px(kFieldRow), context.px(kGapS));
  text_field(context, fields.take_right(context.px(200.0F), context.px(kGapM)),
             {"sphere_diameter", context.text(Text::kSphereDiameter)}, form.sphere_diameter_mm);
  form.is_edited |=
      path_field(context, fields, {"calibration_folder", context.text(Text::kCalibrationFolder)},
                 PathField::kCalibrationFolder, form.folder);
  const std::string continues = context.text(Text::kCalibrationContinues);
  ImFont* const small = context.theme.fonts.small;
  draw_wrapped(
      dialog.rest.take_top(wrapped_height(small, dialog.rest.width, continues), context.px(kGapM)),
      {small, kTextQuiet}, continues);
  text_field(context, dialog.rest.take_top(context.px(kFieldRow), context.px(kGapS)),
             {"calibration_note", context.text(Text::kCalibrationNote)}, form.note);
  if (const auto& calibration = context.view.calibration->calibration)
    draw_calibration_history(context, dialog.rest, calibration->history);
}

std::string headline(const Texts& texts, const RunningCalibration& running) {
  switch (running.step) {
    case CalibrationStep::kOpening:
      return texts[Text::kStartingDevices];
    case CalibrationStep::kTarget:
      if (running.wanted) {
        const CalibrationPlace& place = running.places[*running.wanted];
        return texts.fill<Text::kPutTarget>(place.target, place.where);
      }
      return {};
    case CalibrationStep::kTaking:
      return texts[Text::kTakingImages];
    case CalibrationStep::kComputing:
      return texts[Text::kComputing];
    case CalibrationStep::kRefused:
      return texts[Text::kImagesDoNotFit];
    case CalibrationStep::kFailed:
      return texts[running.task == CalibrationTask::kCalibrate ? Text::kCalibrationStopped
                                                               : Text::kCheckStopped];
    case CalibrationStep::kDone:
      break;
  }
  return running.outcome.verdict;
}

Color color_of(const RunningCalibration& running) {
  switch (running.step) {
    case CalibrationStep::kRefused:
      return kCaution;
    case CalibrationStep::kFailed:
      return kBad;
    case CalibrationStep::kDone:
      return running.outcome.is_good ? kGood : kBad;
    default:
      return kText;
  }
}

/// The text below the headline.
std::string advice(const Texts& texts, const RunningCalibration& running) {
  switch (running.step) {
    case CalibrationStep::kRefused:
      return sentence(running.message) + "\n" + texts[Text::kChoosePlaceBelow];
    case CalibrationStep::kTarget:
      return texts.fill<Text::kHoldStill>(running.wanted.value_or(0) + 1, running.places.size(),
                                          texts[Text::kKeyEnter]);
    case CalibrationStep::kDone:
      return fmt::format("{}", fmt::join(running.outcome.meanings, "\n"));
    default:
      return sentence(running.message);
  }
}

void draw_report(const PanelContext& context, Rect box, const RunningCalibration& running) {
  const Fonts& fonts = context.theme.fonts;
  const std::string title = headline(context.view.texts, running);
  const float height = wrapped_height(fonts.title, box.width, title);
  draw_wrapped(box.take_top(height, context.px(kGapS)), {fonts.title, color_of(running)}, title);
  const std::string text = advice(context.view.texts, running);
  if (!text.empty()) {
    const Rect part = box.take_top(wrapped_height(fonts.body, box.width, text), context.px(kGapM));
    draw_wrapped(part, {fonts.body, kText}, text);
  }
  if (running.step == CalibrationStep::kComputing) {
    meter(context.theme, box.take_top(context.px(kGapS)), running.computed_share, kNeutral);
    return;
  }
  draw_judged_shots(context, box, running);
}

void draw_seen(const PanelContext& context, const Rect& box, const RunningCalibration& running) {
  if (running.step == CalibrationStep::kDone) return draw_outcome(context, box, running.outcome);
  CameraPicture& picture = context.pictures.target;
  picture.show(running.image);
  show_camera_image(context, box, picture, context.text(Text::kNoImageYet));
}

void draw_buttons(const PanelContext& context, Rect row, const RunningCalibration& running) {
  const bool is_done = running.step == CalibrationStep::kDone;
  const ActionLook main =
      is_done ? ActionLook{icon::kSaved, context.text(Text::kUseCalibration), true, kNeutral}
              : ActionLook{icon::kDevice, context.text(Text::kTakeImages), true, kNeutral};
  const bool has_main = !is_done || running.task == CalibrationTask::kCalibrate;
  const float width =
      std::max(small_action_width(context, Action::kConfirm, main), context.px(200.0F));
  if (has_main)
    small_action(context, row.take_right(width, context.px(kGapM)), Action::kConfirm, main);
  const ActionLook stop = {icon::kCancel, context.text(is_done ? Text::kClose : Text::kStop)};
  small_action(context,
               row.take_left(small_action_width(context, Action::kCancel, stop), context.px(kGapM)),
               Action::kCancel, stop);
  const ActionLook back = {icon::kUndo};
  if (!is_done) {
    small_action(
        context,
        row.take_left(small_action_width(context, Action::kPreviousPlace, back), context.px(kGapM)),
        Action::kPreviousPlace, back);
  }
  const std::string& why = context.view.calibration->why_not_used;
  if (is_done && has_main && !why.empty()) {
    draw_text(row, {context.theme.fonts.small, kTextQuiet, Align::kRight}, why);
  } else if (!is_done && !running.folder.empty()) {
    draw_text(row, {context.theme.fonts.small, kTextQuiet, Align::kRight},
              context.view.texts.fill<Text::kSavedIn>(running.folder));
  }
}

void draw_running(const PanelContext& context, const RunningCalibration& running) {
  DialogPlate dialog(context, context.text(title_of(running.task)), {1216.0F, 752.0F},
                     ClickBeside::kNothing);
  Rect rest = dialog.rest;
  draw_buttons(context, rest.take_bottom(context.px(kButtonRow), context.px(kGapM)), running);
  const float places = calibration_places_height(context, running);
  draw_calibration_places(context, rest.take_bottom(places, context.px(kGapM)), running);
  draw_seen(context, rest.take_left(rest.width * kImageShare, context.px(kGapL)), running);
  draw_report(context, rest, running);
}

}  // namespace

void draw_calibration_panel(const PanelContext& context) {
  const auto& calibration = context.view.calibration;
  if (!calibration) return;
  if (calibration->running) return draw_running(context, *calibration->running);
  draw_choices(context);
}

}  // namespace flytri::ui
