/// @file  Language, interface size, sound, full screen, and buttons to the devices and the
/// calibration.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

#include "core/calibration/record/sensor_size.h"
#include "ui/panels/dialog.h"
#include "ui/panels/panels.h"
#include "ui/panels/recording_text.h"
#include "ui/theme/icons.h"
#include "ui/widgets/hint.h"
#include "ui/widgets/meter.h"

namespace flytri::ui {
namespace {

constexpr float kSettingsWidth = 680.0F, kSettingsRow = 48.0F, kLanguageCaption = 20.0F;
/// What the dialog needs beside its rows: the caption of the languages and the folder of
/// recordings.
constexpr float kBesideRows = kLanguageCaption + kGapXs + kFieldRow;
constexpr float kSettingsRows = 9.0F;

/// @param code  of the language; empty: that of the desktop
void draw_language_button(const PanelContext& context, const Rect& box, const std::string& code,
                          const char* label) {
  const std::string id = "language_" + (code.empty() ? "automatic" : code);
  ButtonLook look;
  look.id = id.c_str();
  look.label = label;
  look.is_on = context.view.settings.language == code;
  context.places.set(id, box);
  if (!small_button(context.theme, box, look)) return;
  Settings settings = context.view.settings;
  settings.language = code;
  context.commands.emplace_back(ChangeSettings{settings});
}

/// Each language by its own name, so that one finds back from a language that one cannot read.
void draw_language(const PanelContext& context, DialogPlate& dialog, float row_height) {
  draw_text(dialog.rest.take_top(context.px(kLanguageCaption), context.px(kGapXs)),
            {context.theme.fonts.body, kText, Align::kLeft}, context.text(Text::kLanguage));
  Rect row = dialog.rest.take_top(row_height, context.px(kGapS));
  const float gap = context.px(kGapXs), count = kLanguages.size() + 1.0F;
  const float width = (row.width - (count - 1.0F) * gap) / count;
  draw_language_button(context, row.take_left(width, gap), "", context.text(Text::kAutomatic));
  for (const LanguageName& language : kLanguages) {
    draw_language_button(context, row.take_left(width, gap), std::string(language.code),
                         language.name);
  }
}

void draw_size(const PanelContext& context, Rect row) {
  const float side = context.px(64.0F);
  small_action(context, row.take_right(side, context.px(kGapXs)), Action::kLarger,
               {nullptr, "+", false, kNeutral, false});
  draw_text(row.take_right(context.px(80.0F), context.px(kGapXs)),
            {context.theme.fonts.strong, kText, Align::kCenter},
            fmt::format("{:.0f} %", 100.0 * context.view.settings.user_scale));
  small_action(context, row.take_right(side, context.px(kGapM)), Action::kSmaller,
               {nullptr, "\u2212", false, kNeutral, false});
  draw_text(row, {context.theme.fonts.body, kText, Align::kLeft},
            context.text(Text::kInterfaceSize));
}

void draw_sound(const PanelContext& context, Rect row) {
  const bool is_muted = context.view.settings.is_muted;
  small_action(context, row.take_right(context.px(64.0F * 2.0F + 80.0F + 2.0F * kGapXs)),
               Action::kMute,
               {is_muted ? icon::kMuted : icon::kSound,
                context.text(is_muted ? Text::kButtonMuted : Text::kButtonOn)});
  draw_text(row, {context.theme.fonts.body, kText, Align::kLeft},
            context.text(Text::kTrackingSounds));
}

void draw_full_screen(const PanelContext& context, Rect row) {
  const bool is_full = context.view.settings.is_full_screen;
  small_action(context, row.take_right(context.px(64.0F * 2.0F + 80.0F + 2.0F * kGapXs)),
               Action::kFullScreen,
               {nullptr, context.text(is_full ? Text::kButtonOn : Text::kButtonOff)});
  draw_text(row, {context.theme.fonts.body, kText, Align::kLeft}, context.text(Text::kFullScreen));
}

/// Widths of holes to choose from, of a sensor for teeth.
constexpr std::array kHoleWidths_mm = {0.0, 0.5, 1.0, 2.0};

void draw_close_holes(const PanelContext& context, Rect row) {
  Rect buttons = row.take_right(context.px(64.0F * 4.0F + 3.0F * kGapXs), context.px(kGapM));
  for (const double width_mm : kHoleWidths_mm) {
    const Rect box = buttons.take_left(context.px(64.0F), context.px(kGapXs));
    const std::string id = fmt::format("close_holes_{}", width_mm);
    const double shown_mm = width_mm * calibration::line_distance_factor(context.view.volume_mm);
    const std::string label = width_mm > 0.0 ? fmt::format("{} mm", shown_mm)
                                             : std::string(context.text(Text::kButtonOff));
    ButtonLook look;
    look.id = id.c_str();
    look.label = label.c_str();
    look.is_on = context.view.settings.close_holes_mm == width_mm;
    context.places.set(id, box);
    if (!small_button(context.theme, box, look)) continue;
    Settings settings = context.view.settings;
    settings.close_holes_mm = width_mm;
    context.commands.emplace_back(ChangeSettings{settings});
  }
  hint_over(row, context.view.texts[Text::kCloseHolesHint]);
  draw_text(row, {context.theme.fonts.body, kText, Align::kLeft}, context.text(Text::kCloseHoles));
}

void draw_devices(const PanelContext& context, Rect row) {
  small_action(context, row.take_right(context.px(64.0F * 2.0F + 80.0F + 2.0F * kGapXs)),
               Action::kDevices, {icon::kDevice, context.text(Text::kShow)});
  draw_text(row, {context.theme.fonts.body, kText, Align::kLeft},
            context.text(Text::kCamerasAndLights));
}

void draw_calibration(const PanelContext& context, Rect row) {
  small_action(context, row.take_right(context.px(64.0F * 2.0F + 80.0F + 2.0F * kGapXs)),
               Action::kCalibration, {icon::kTarget, context.text(Text::kShow)});
  draw_text(row, {context.theme.fonts.body, kText, Align::kLeft},
            context.text(Text::kSensorCalibration));
}

void draw_set_up(const PanelContext& context, Rect row) {
  small_action(context, row.take_right(context.px(64.0F * 2.0F + 80.0F + 2.0F * kGapXs)),
               Action::kSetUp, {icon::kSettings, context.text(Text::kShow)});
  draw_text(row, {context.theme.fonts.body, kText, Align::kLeft}, context.text(Text::kSetUpSensor));
}

void draw_recording(const PanelContext& context, DialogPlate& dialog, float row_height) {
  RecordingForm& form = context.state.recording_form;
  const RecordingState& recording = context.view.recording;
  Rect row = dialog.rest.take_top(row_height, context.px(kGapS));
  small_action(context, row.take_right(context.px(64.0F * 2.0F + 80.0F + 2.0F * kGapXs)),
               Action::kRecord,
               {nullptr, context.text(recording.is_on ? Text::kButtonOn : Text::kButtonOff)});
  if (!recording.failure.empty()) hint_over(row, recording.failure);
  draw_text(row.take_top(row.height / 2.0F), {context.theme.fonts.body, kText, Align::kLeft},
            context.text(Text::kRecordRawImages));
  const Color ink = recording.failure.empty() ? kTextQuiet : kCaution;
  draw_text(row, {context.theme.fonts.small, ink, Align::kLeft},
            recording_text(recording, context.view.texts));
  if (!form.is_edited) form.folder = recording.folder;
  form.is_edited |= path_field(context, dialog.rest.take_top(context.px(kFieldRow)),
                               {"recording_folder", context.text(Text::kRecordingFolder)},
                               PathField::kRecordingFolder, form.folder);
}

}  // namespace

void draw_settings_dialog(const PanelContext& context) {
  DialogPlate dialog(
      context, context.text(Text::kSettings),
      {kSettingsWidth, 96.0F + kSettingsRows * (kSettingsRow + kGapS) + kBesideRows});
  // Rows are lower in a low window.
  const float row =
      std::min(context.px(kSettingsRow),
               (dialog.rest.height - context.px(kBesideRows)) / kSettingsRows - context.px(kGapS));
  const auto next_row = [&] { return dialog.rest.take_top(row, context.px(kGapS)); };
  draw_language(context, dialog, row);
  draw_size(context, next_row());
  draw_sound(context, next_row());
  draw_full_screen(context, next_row());
  draw_close_holes(context, next_row());
  draw_devices(context, next_row());
  draw_calibration(context, next_row());
  draw_set_up(context, next_row());
  draw_recording(context, dialog, row);
}

}  // namespace flytri::ui
