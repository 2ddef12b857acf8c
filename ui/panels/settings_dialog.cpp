/// @file  Interface size, sound, full screen, and buttons to the devices and the calibration.
#include <fmt/format.h>

#include "ui/panels/dialog.h"
#include "ui/panels/panels.h"
#include "ui/panels/recording_text.h"
#include "ui/theme/icons.h"
#include "ui/widgets/meter.h"

namespace flytri::ui {
namespace {

constexpr float kSettingsRow = 48.0F;

void draw_size(const PanelContext& context, Rect row) {
  const float side = context.px(64.0F);
  small_action(context, row.take_right(side, context.px(kGapXs)), Action::kLarger,
               {nullptr, "+", false, kNeutral, false});
  draw_text(row.take_right(context.px(80.0F), context.px(kGapXs)),
            {context.theme.fonts.strong, kText, Align::kCenter},
            fmt::format("{:.0f} %", 100.0 * context.view.settings.user_scale));
  small_action(context, row.take_right(side, context.px(kGapM)), Action::kSmaller,
               {nullptr, "\u2212", false, kNeutral, false});
  draw_text(row, {context.theme.fonts.body, kText, Align::kLeft}, "Interface size");
}

void draw_sound(const PanelContext& context, Rect row) {
  const bool is_muted = context.view.settings.is_muted;
  small_action(context, row.take_right(context.px(64.0F * 2.0F + 80.0F + 2.0F * kGapXs)),
               Action::kMute, {is_muted ? icon::kMuted : icon::kSound, is_muted ? "Muted" : "On"});
  draw_text(row, {context.theme.fonts.body, kText, Align::kLeft}, "Tracking sounds");
}

void draw_full_screen(const PanelContext& context, Rect row) {
  const bool is_full = context.view.settings.is_full_screen;
  small_action(context, row.take_right(context.px(64.0F * 2.0F + 80.0F + 2.0F * kGapXs)),
               Action::kFullScreen, {nullptr, is_full ? "On" : "Off"});
  draw_text(row, {context.theme.fonts.body, kText, Align::kLeft}, "Full screen");
}

void draw_devices(const PanelContext& context, Rect row) {
  small_action(context, row.take_right(context.px(64.0F * 2.0F + 80.0F + 2.0F * kGapXs)),
               Action::kDevices, {icon::kDevice, "Show"});
  draw_text(row, {context.theme.fonts.body, kText, Align::kLeft}, "Cameras and lights");
}

void draw_calibration(const PanelContext& context, Rect row) {
  small_action(context, row.take_right(context.px(64.0F * 2.0F + 80.0F + 2.0F * kGapXs)),
               Action::kCalibration, {icon::kTarget, "Show"});
  draw_text(row, {context.theme.fonts.body, kText, Align::kLeft}, "Sensor calibration");
}

void draw_recording(const PanelContext& context, DialogPlate& dialog) {
  RecordingForm& form = context.state.recording_form;
  const RecordingState& recording = context.view.recording;
  Rect row = dialog.rest.take_top(context.px(kSettingsRow), context.px(kGapS));
  small_action(context, row.take_right(context.px(64.0F * 2.0F + 80.0F + 2.0F * kGapXs)),
               Action::kRecord, {nullptr, recording.is_on ? "On" : "Off"});
  draw_text(row, {context.theme.fonts.body, kText, Align::kLeft}, "Record raw images");
  if (!form.is_edited) form.folder = recording.folder;
  form.is_edited |= path_field(context, dialog.rest.take_top(context.px(kFieldRow)),
                               {"recording_folder", "Folder for recordings"},
                               PathField::kRecordingFolder, form.folder);
  const Color ink = recording.failure.empty() ? kTextQuiet : kCaution;
  draw_wrapped(dialog.rest, {context.theme.fonts.small, ink}, recording_text(recording));
}

}  // namespace

void draw_settings_dialog(const PanelContext& context) {
  DialogPlate dialog(context, "Settings",
                     {560.0F, 320.0F + 2.0F * (kSettingsRow + kGapS) + kFieldRow + 56.0F});
  draw_size(context, dialog.rest.take_top(context.px(kSettingsRow), context.px(kGapS)));
  draw_sound(context, dialog.rest.take_top(context.px(kSettingsRow), context.px(kGapS)));
  draw_full_screen(context, dialog.rest.take_top(context.px(kSettingsRow), context.px(kGapS)));
  draw_devices(context, dialog.rest.take_top(context.px(kSettingsRow), context.px(kGapS)));
  draw_calibration(context, dialog.rest.take_top(context.px(kSettingsRow), context.px(kGapS)));
  draw_recording(context, dialog);
}

}  // namespace flytri::ui
