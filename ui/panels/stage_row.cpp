#include "ui/panels/stage_row.h"

#include <fmt/format.h>

#include <span>

#include "ui/theme/icons.h"

namespace flytri::ui {
namespace {

constexpr float kStageRow = 36.0F;

void draw_stage_button(const PanelContext& context, const Rect& box, io::ScanStage stage) {
  const std::string id = fmt::format("scan_{}", to_string(stage));
  ButtonLook look;
  look.id = id.c_str();
  look.icon = mark_of(progress_of(stage, context.view));
  look.label = context.text(name_in_group(stage));
  look.is_enabled = scan::may_leave(context.phase());
  look.is_on = context.view.stage == stage;
  look.hint = context.text(stage_name(stage));
  context.places.set(id, box);
  if (small_button(context.theme, box, look)) context.commands.emplace_back(SelectStage{stage});
}

void draw_stage_buttons(const PanelContext& context, Rect row,
                        std::span<const io::ScanStage> stages) {
  const float gap = context.px(kGapXs);
  const auto count = static_cast<float>(stages.size());
  const float width = (row.width - (count - 1.0F) * gap) / count;
  for (const io::ScanStage stage : stages)
    draw_stage_button(context, row.take_left(width, gap), stage);
}

}  // namespace

const char* mark_of(StageProgress progress) {
  if (progress == StageProgress::kFinished) return icon::kSaved;
  return progress == StageProgress::kScanned ? icon::kScanned : nullptr;
}

void draw_stage_row(const PanelContext& context, Rect& rest) {
  const io::ScanStage shown = context.view.stage;
  const std::vector<io::ScanStage> stages = offered_with(shown, context.view);
  const bool has_others =
      io::is_jaw(shown) && progress_of_group(shown, context.view) != StageProgress::kEmpty;
  if ((stages.size() < 2 && !has_others) || context.view.is_scanning) return;
  // Two labels and the button do not fit beside each other in a narrow panel.
  const std::size_t in_first = has_others ? 1 : stages.size();
  const float gap = context.px(kGapXs);
  Rect row =
      rest.take_top(context.px(kStageRow), in_first < stages.size() ? gap : context.px(kGapM));
  if (has_others) {
    small_action(context, row.take_right(row.height, gap), Action::kStages,
                 {nullptr, "+", false, kNeutral, false});
  }
  draw_stage_buttons(context, row, std::span(stages).first(in_first));
  if (in_first == stages.size()) return;
  draw_stage_buttons(context, rest.take_top(context.px(kStageRow), context.px(kGapM)),
                     std::span(stages).subspan(in_first));
}

}  // namespace flytri::ui
