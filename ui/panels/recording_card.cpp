/// @file  Says at the lower right of the scene that raw images are recorded, and how much room is
/// left.
#include "ui/panels/panels.h"
#include "ui/panels/recording_text.h"
#include "ui/theme/icons.h"
#include "ui/widgets/hint.h"

namespace flytri::ui {
namespace {

constexpr float kRecordingWidth = 340.0F, kToolStripRoom = 76.0F;

bool shows_recording(const RecordingState& recording) {
  return recording.is_on || !recording.failure.empty();
}

/// A failure stays until the next recording, and takes more lines.
float card_height(const PanelContext& context) {
  return context.px(context.view.recording.failure.empty() ? 36.0F : 88.0F);
}

}  // namespace

float recording_card_height(const PanelContext& context) {
  if (!shows_recording(context.view.recording)) return 0.0F;
  return card_height(context) + context.px(kGapS);
}

void draw_recording_card(const PanelContext& context) {
  const RecordingState& recording = context.view.recording;
  if (!shows_recording(recording)) return;
  const Rect& picture = context.layout.picture;
  const float width = context.px(kRecordingWidth), height = card_height(context);
  float bottom = picture.bottom() - context.px(kGapM);
  if (context.state.tool != Tool::kNone) bottom -= context.px(kToolStripRoom);
  const Rect box = {picture.right() - context.px(kGapM) - width, bottom - height, width, height};
  context.places.set("recording", box);
  const Plate plate("recording", box, overlay(context.theme));
  Rect row = box.inset(context.px(kGapM), 0.0F);
  const Fonts& fonts = context.theme.fonts;
  const float dot = context.px(12.0F);
  draw_box(row.take_left(dot, context.px(kGapS)).centered(dot, dot),
           recording.is_on ? kBad : kCaution, dot / 2.0F);
  draw_fitted(row, {fonts.small}, recording.failure.empty() ? kText : kCaution,
              recording_text(recording, context.view.texts));
  hint_over(box, recording.failure.empty()
                     ? context.view.texts.fill<Text::kRecordingHint>(recording.path)
                     : recording.failure);
}

}  // namespace flytri::ui
