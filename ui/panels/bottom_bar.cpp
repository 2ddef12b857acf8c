/// @file  The large buttons: one for scanning, then those for editing, finishing and export.
#include <algorithm>
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
    return {icon::kResume, context.text(Text::kResume), false, kGood};
  }
  if (context.view.is_scanning) return {icon::kPause, context.text(Text::kPause), true, kNeutral};
  const Text label = is_paused(context.view) ? Text::kResume : Text::kScan;
  return {icon::kScan, context.text(label), true, kGood};
}

constexpr std::size_t kEntries = 9;
using Widths = std::array<float, kEntries>;

std::array<Entry, kEntries> entries(const PanelContext& context) {
  const bool exports_next = context.phase() == scan::ScanPhase::kFinished;
  return {{{Action::kUndo, {icon::kUndo}},
           {Action::kRedo, {icon::kRedo}},
           {Action::kTrim, {.icon = icon::kTrim, .color = kCaution}},
           {Action::kLock, {icon::kLock}},
           {Action::kUnlock, {icon::kUnlock}},
           {Action::kMeasure, {icon::kMeasure}},
           {Action::kFinish, {icon::kFinish}},
           {Action::kExport, {.icon = icon::kExport, .is_main = exports_next}},
           {Action::kHelp, {icon::kHelp}}}};
}

/// All alike if each label fits so; else each gets a share of the width as its label needs.
Widths entry_widths(const PanelContext& context, const std::array<Entry, kEntries>& entries,
                    float width) {
  const float margin = context.px(kGapS) + 1.0F, equal = width / static_cast<float>(kEntries);
  Widths needed;
  float sum = 0.0F, widest = 0.0F;
  for (std::size_t i = 0; i < kEntries; ++i) {
    const char* label = context.text(row_of(entries[i].action).name);
    needed[i] = text_width(context.theme.fonts.strong, label) + margin;
    sum += needed[i];
    widest = std::max(widest, needed[i]);
  }
  const float spare = (width - sum) / static_cast<float>(kEntries);
  for (float& one : needed) {
    one = widest <= equal ? equal : (spare >= 0.0F ? one + spare : one * width / sum);
  }
  return needed;
}

}  // namespace

void draw_bottom_bar(const PanelContext& context) {
  const Plate plate("bottom", context.layout.bottom);
  const float gap = context.px(kGapS);
  Rect row = context.layout.bottom.inset(context.px(kGapM));
  const auto rest = entries(context);
  const float scan_width = context.px(176.0F);
  constexpr auto kCount = static_cast<float>(kEntries);
  const Widths widths = entry_widths(
      context, rest, row.width - scan_width - context.px(kGapM) - (kCount - 1.0F) * gap);
  large_action(context, row.take_left(scan_width, context.px(kGapM)), Action::kScan,
               scan_look(context));
  for (std::size_t i = 0; i < rest.size(); ++i) {
    large_action(context, row.take_left(widths[i], gap), rest[i].action, rest[i].look);
  }
}

}  // namespace flytri::ui
