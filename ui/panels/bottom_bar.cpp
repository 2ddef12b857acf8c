/// @file  The large buttons: one for scanning, then those for editing, finishing and export.
#include <array>

#include "ui/panels/panels.h"
#include "ui/theme/icons.h"

namespace flytri::ui {
namespace {

struct Entry {
  Action action;
  ActionLook look;
};

bool is_paused(const AppView& view) {
  return view.scan != nullptr && surfel_count(view.scan->model) > 0;
}

/// The look of the main button: scan, pause or resume.
ActionLook scan_look(const PanelContext& context) {
  if (context.phase() == scan::ScanPhase::kFinished) {
    return {icon::kResume, "Resume", false, kGood};
  }
  if (context.view.is_scanning) return {icon::kPause, "Pause", true, kNeutral};
  return {icon::kScan, is_paused(context.view) ? "Resume" : "Scan", true, kGood};
}

std::array<Entry, 9> entries(const PanelContext& context) {
  const bool exports_next = context.phase() == scan::ScanPhase::kFinished;
  return {{{Action::kUndo, {icon::kUndo, "Undo"}},
           {Action::kRedo, {icon::kRedo, "Redo"}},
           {Action::kTrim, {icon::kTrim, "Trim", false, kCaution}},
           {Action::kLock, {icon::kLock, "Lock"}},
           {Action::kUnlock, {icon::kUnlock, "Unlock"}},
           {Action::kMeasure, {icon::kMeasure, "Measure"}},
           {Action::kFinish, {icon::kFinish, "Finish"}},
           {Action::kExport, {icon::kExport, "Export", exports_next, kNeutral}},
           {Action::kHelp, {icon::kHelp, "Keys"}}}};
}

}  // namespace

void draw_bottom_bar(const PanelContext& context) {
  const Plate plate("bottom", context.layout.bottom);
  const float gap = context.px(kGapS);
  Rect row = context.layout.bottom.inset(context.px(kGapM));
  const auto rest = entries(context);
  const float scan_width = context.px(176.0F);
  const auto count = static_cast<float>(rest.size());
  const float width = (row.width - scan_width - context.px(kGapM) - (count - 1.0F) * gap) / count;
  large_action(context, row.take_left(scan_width, context.px(kGapM)), Action::kScan,
               scan_look(context));
  for (const Entry& entry : rest) {
    large_action(context, row.take_left(width, gap), entry.action, entry.look);
  }
}

}  // namespace flytri::ui
