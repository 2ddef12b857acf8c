#include "ui/state/stage_group.h"

#include "core/calibration/record/sensor_size.h"

namespace flytri::ui {

std::vector<io::ScanStage> offered_with(io::ScanStage stage, const AppView& view) {
  std::vector<io::ScanStage> offered;
  for (const io::ScanStage other : io::kScanStages) {
    if (base_of(other) != base_of(stage)) continue;
    const bool follows_bite = other == io::ScanStage::kBite2 &&
                              progress_of(io::ScanStage::kBite, view) != StageProgress::kEmpty;
    if (other == base_of(other) || other == view.stage || follows_bite ||
        progress_of(other, view) != StageProgress::kEmpty)
      offered.push_back(other);
  }
  return offered;
}

std::vector<io::ScanStage> offered_tabs(const AppView& view) {
  std::vector<io::ScanStage> tabs;
  for (const io::ScanStage stage : io::kScanStages) {
    if (stage != base_of(stage)) continue;
    const bool is_for_sensor =
        calibration::fits_mouth(view.volume_mm) != (stage == io::ScanStage::kFace);
    if (is_for_sensor || progress_of_group(stage, view) != StageProgress::kEmpty ||
        base_of(view.stage) == stage)
      tabs.push_back(stage);
  }
  return tabs;
}

Text name_in_group(io::ScanStage stage) {
  constexpr std::array kNames = {Text::kUpperJaw,  Text::kLowerJaw, Text::kBite,
                                 Text::kOtherSide, Text::kPreop,    Text::kPreop,
                                 Text::kScanBody,  Text::kScanBody, Text::kFace};
  static_assert(kNames.size() == io::kScanStages.size());
  return kNames[index_of(stage)];
}

Text tab_name(io::ScanStage stage) {
  constexpr std::array kNames = {Text::kStageUpper, Text::kStageLower, Text::kStageBite,
                                 Text::kStageBite2, Text::kPreop,      Text::kPreop,
                                 Text::kScanBody,   Text::kScanBody,   Text::kFace};
  static_assert(kNames.size() == io::kScanStages.size());
  return kNames[index_of(stage)];
}

bool can_copy_to(io::ScanStage stage, const AppView& view) {
  const bool is_ready = !view.file.path.empty() && !view.file.is_read_only && !view.is_loading &&
                        view.file.failure.empty() && view.scan != nullptr &&
                        scan::may_leave(view.scan->phase);
  return is_ready && are_of_one_jaw(view.stage, stage) &&
         progress_of(view.stage, view) != StageProgress::kEmpty &&
         progress_of(stage, view) == StageProgress::kEmpty;
}

StageProgress progress_of(io::ScanStage stage, const AppView& view) {
  if (view.stage_is_finished[index_of(stage)]) return StageProgress::kFinished;
  return view.stage_has_data[index_of(stage)] ? StageProgress::kScanned : StageProgress::kEmpty;
}

StageProgress progress_of_group(io::ScanStage stage, const AppView& view) {
  StageProgress progress = StageProgress::kEmpty;
  for (const io::ScanStage other : io::kScanStages) {
    if (base_of(other) != base_of(stage)) continue;
    const StageProgress one = progress_of(other, view);
    if (one == StageProgress::kScanned) return one;
    if (one == StageProgress::kFinished) progress = one;
  }
  return progress;
}

}  // namespace flytri::ui
