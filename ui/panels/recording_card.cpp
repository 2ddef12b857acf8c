/// @file  Says at the lower right of the scene that raw images are recorded, and how much room is
/// left.
#include "ui/panels/panels.h"
#include "ui/panels/recording_text.h"
#include "ui/theme/icons.h"
#include "ui/widgets/hint.h"

namespace flytri::ui {
namespace {

constexpr float kRecordingWidth = 340.0F, kRecordingHeight = 36.0F, kToolStripRoom = 76.0F;

}  // namespace

float recording_card_height(const PanelContext& context) {
  if (!context.view.recording.is_on) return 0.0F;
  return context.px(kRecordingHeight + kGapS);
}

void draw_recording_card(const PanelContext& context) {
  if (!context.view.recording.is_on) return;
  const Rect& picture = context.layout.picture;
  const float width = context.px(kRecordingWidth), height = context.px(kRecordingHeight);
  float bottom = picture.bottom() - context.px(kGapM);
  if (context.state.tool != Tool::kNone) bottom -= context.px(kToolStripRoom);
  const Rect box = {picture.right() - context.px(kGapM) - width, bottom - height, width, height};
  context.places.set("recording", box);
  const Plate plate("recording", box, overlay(context.theme));
  Rect row = box.inset(context.px(kGapM), 0.0F);
  const Fonts& fonts = context.theme.fonts;
  draw_text(row.take_left(context.px(14.0F), context.px(kGapS)), {fonts.strong, kBad}, "\u25cf");
  const Color ink = context.view.recording.failure.empty() ? kText : kCaution;
  draw_text(row, {fonts.small, ink, Align::kLeft},
            recording_text(context.view.recording, context.view.texts));
  hint_over(box, context.view.texts.fill<Text::kRecordingHint>(context.view.recording.path));
}

}  // namespace flytri::ui
