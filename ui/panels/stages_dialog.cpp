/// @file  The scans of a jaw: the ordinary one, before a preparation, with scan bodies. One can
/// start as a copy of another.
#include <fmt/format.h>

#include <algorithm>

#include "ui/panels/dialog.h"
#include "ui/panels/panels.h"
#include "ui/panels/stage_row.h"
#include "ui/state/jaw_words.h"
#include "ui/state/window_state.h"

namespace flytri::ui {
namespace {

constexpr float kScansWidth = 720.0F, kScanRow = 88.0F, kCopiesNote = 40.0F;
constexpr float kScanButton = 44.0F, kOpenWidth = 120.0F, kCopyWidth = 208.0F, kScanMark = 24.0F;

Text purpose_of(io::ScanStage stage) {
  if (io::is_preop(stage)) return Text::kPreopHint;
  return stage == base_of(stage) ? Text::kJawHint : Text::kScanBodyHint;
}

bool scans_button(const PanelContext& context, const Rect& box, const std::string& id,
                  ButtonLook look) {
  look.id = id.c_str();
  context.places.set(id, box);
  if (!small_button(context.theme, box, look)) return false;
  context.state.dialog = Dialog::kNone;
  return true;
}

void draw_open_scan(const PanelContext& context, const Rect& box, io::ScanStage stage) {
  const bool is_empty = progress_of(stage, context.view) == StageProgress::kEmpty;
  ButtonLook look;
  look.label = context.text(is_empty ? Text::kScanAnew : Text::kOpen);
  look.is_enabled = stage != context.view.stage;
  if (scans_button(context, box, fmt::format("open_{}", to_string(stage)), look))
    context.commands.emplace_back(SelectStage{stage});
}

/// What a scan is kept as before a preparation stays as it is; all others go on as the copy.
void draw_copy_scan(const PanelContext& context, const Rect& box, io::ScanStage stage) {
  const bool is_kept = io::is_preop(stage);
  ButtonLook look;
  look.label = context.text(is_kept ? Text::kKeepAsPreop : Text::kStartAsCopy);
  look.is_main = true;
  if (!scans_button(context, box, fmt::format("copy_{}", to_string(stage)), look)) return;
  const io::ScanStage shown = context.view.stage;
  context.state.copy = CopyOnItsWay{shown, is_kept ? shown : stage};
  context.commands.emplace_back(CopyStage{stage});
}

void draw_scan(const PanelContext& context, Rect row, io::ScanStage stage) {
  const Theme& theme = context.theme;
  draw_outline(row, kHairline, context.px(1.0F), context.px(kRounding));
  row = row.inset(context.px(kGapM), context.px(kGapS));
  Rect buttons = row.take_right(context.px(kOpenWidth + kGapS + kCopyWidth), context.px(kGapM));
  buttons = buttons.centered(buttons.width, context.px(kScanButton));
  draw_open_scan(context, buttons.take_right(context.px(kOpenWidth), context.px(kGapS)), stage);
  if (can_copy_to(stage, context.view)) draw_copy_scan(context, buttons, stage);
  Rect head = row.take_top(context.px(24.0F), context.px(kGapXs));
  const char* const mark = mark_of(progress_of(stage, context.view));
  if (mark != nullptr) {
    draw_text(head.take_left(context.px(kScanMark)), {theme.fonts.strong, kText, Align::kLeft},
              mark);
  }
  draw_text(head, {theme.fonts.strong, kText, Align::kLeft}, context.text(name_in_group(stage)));
  draw_wrapped(row, {theme.fonts.small, kTextQuiet}, context.text(purpose_of(stage)));
}

}  // namespace

void draw_stages_dialog(const PanelContext& context) {
  const io::ScanStage base = base_of(context.view.stage);
  const auto count = static_cast<float>(
      std::count_if(io::kScanStages.begin(), io::kScanStages.end(),
                    [&](io::ScanStage stage) { return base_of(stage) == base; }));
  DialogPlate dialog(
      context, context.text(stage_name(base)),
      {kScansWidth, 2.0F * kGapL + 32.0F + kGapM + count * (kScanRow + kGapS) + kCopiesNote});
  for (const io::ScanStage stage : io::kScanStages) {
    if (base_of(stage) != base) continue;
    draw_scan(context, dialog.rest.take_top(context.px(kScanRow), context.px(kGapS)), stage);
  }
  draw_wrapped(dialog.rest, {context.theme.fonts.small, kTextQuiet},
               context.text(Text::kCopiesHint));
}

}  // namespace flytri::ui
