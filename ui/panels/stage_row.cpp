#include "ui/panels/stage_row.h"

#include <fmt/format.h>

#include "ui/theme/icons.h"

namespace flytri::ui {
namespace {

constexpr float kStageRow = 36.0F;

Action action_of(io::ScanStage stage) {
  constexpr std::array kActions = {Action::kStageUpper, Action::kStageLower, Action::kStageBite,
                                   Action::kStageBite2};
  return kActions[index_of(stage)];
}

void draw_stage(const PanelContext& context, const Rect& box, io::ScanStage stage) {
  const Action action = action_of(stage);
  const ActionState current = action_state(action, context.view, context.state);
  const std::string id = fmt::format("scan_{}", to_string(stage));
  ButtonLook look;
  look.id = id.c_str();
  look.icon = mark_of(progress_of(stage, context.view));
  look.label = context.text(name_in_group(stage));
  look.is_enabled = current.is_enabled;
  look.is_on = context.view.stage == stage;
  look.hint = context.text(stage_name(stage));
  context.places.set(id, box);
  if (small_button(context.theme, box, look))
    perform(action, context.view, context.state, context.commands);
}

}  // namespace

const char* mark_of(StageProgress progress) {
  if (progress == StageProgress::kFinished) return icon::kSaved;
  return progress == StageProgress::kScanned ? icon::kScanned : nullptr;
}

void draw_stage_row(const PanelContext& context, Rect& rest) {
  const std::vector<io::ScanStage> stages = offered_with(context.view.stage, context.view);
  if (stages.size() < 2 || context.view.is_scanning) return;
  Rect row = rest.take_top(context.px(kStageRow), context.px(kGapM));
  const float gap = context.px(kGapXs);
  const auto count = static_cast<float>(stages.size());
  const float width = (row.width - (count - 1.0F) * gap) / count;
  for (const io::ScanStage stage : stages) draw_stage(context, row.take_left(width, gap), stage);
}

}  // namespace flytri::ui
