/// @file  The bar at the top: case, stage, time, views kept and not kept, coverage, settings.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ui/panels/panels.h"
#include "ui/panels/stage_row.h"
#include "ui/theme/icons.h"
#include "ui/widgets/badge.h"
#include "ui/widgets/hint.h"
#include "ui/widgets/meter.h"

namespace flytri::ui {
namespace {

std::string case_title(const CaseState& file, const Texts& texts) {
  if (file.path.empty() || file.is_unnamed) return texts[Text::kNoCaseYet];
  return file.fields.patient_name.empty() ? texts[Text::kUnnamedCase] : file.fields.patient_name;
}

std::string case_subtitle(const CaseState& file, const Texts& texts) {
  if (file.damaged) return texts[Text::kDamagedBadge];
  if (!file.failure.empty()) return texts[Text::kNotSavedBadge];
  if (file.is_read_only) return texts[Text::kReadOnly];
  if (file.is_moving) return texts[Text::kSaving];
  if (file.path.empty()) return texts[Text::kNameItHere];
  if (file.is_unnamed) return texts[Text::kSavedWithoutName];
  const char* saved = texts[file.is_saved ? Text::kSaved : Text::kSaving];
  if (file.fields.patient_id.empty()) return saved;
  return file.fields.patient_id + " \u00b7 " + saved;
}

constexpr float kCaseIcon = 20.0F, kCaseIconGap = 10.0F, kCaseMargin = 12.0F;

/// A button that opens the cases; it shows the patient and whether the case is saved.
void draw_case(const PanelContext& context, const Rect& box) {
  ButtonLook look;
  look.id = "case";
  look.is_enabled = action_state(Action::kCase, context.view, context.state).is_enabled;
  look.hint = context.view.texts.fill<Text::kCasesHint>(
      shortcut_text(row_of(Action::kCase).shortcut, context.view.texts));
  context.places.set(look.id, box);
  if (small_button(context.theme, box, look)) {
    perform(Action::kCase, context.view, context.state, context.commands);
  }
  const Theme& theme = context.theme;
  Rect inner = box.inset(context.px(kCaseMargin), context.px(4.0F));
  const Rect icon_box = inner.take_left(context.px(kCaseIcon), context.px(kCaseIconGap));
  draw_text(icon_box, {theme.fonts.strong, kTextQuiet, Align::kCenter}, icon::kCase);
  const float half = inner.height / 2.0F;
  draw_text(inner.take_top(half), {theme.fonts.strong, kText, Align::kLeft},
            case_title(context.view.file, context.view.texts));
  const CaseState& file = context.view.file;
  const bool is_well = file.failure.empty() && !file.damaged;
  draw_text(inner, {theme.fonts.small, is_well ? kTextQuiet : kBad, Align::kLeft},
            case_subtitle(file, context.view.texts));
}

/// Width in which the state of the case is not cut. The patient's name may be.
float case_width(const PanelContext& context) {
  const std::string state = case_subtitle(context.view.file, context.view.texts);
  return std::ceil(text_width(context.theme.fonts.small, state)) +
         context.px(2.0F * kCaseMargin + kCaseIcon + kCaseIconGap);
}

Action action_of(io::ScanStage tab) {
  if (tab == io::ScanStage::kFace) return Action::kStageFace;
  if (tab == io::ScanStage::kBite) return Action::kStageBite;
  return tab == io::ScanStage::kLower ? Action::kStageLower : Action::kStageUpper;
}

constexpr float kStagesWidth = 312.0F;

/// The tab of the shown stage says which scan of its jaw or of the bite that is.
const char* tab_label(const PanelContext& context, io::ScanStage tab) {
  const io::ScanStage shown = context.view.stage;
  return context.text(tab_name(base_of(shown) == tab ? shown : tab));
}

/// Width that the labels of all stages need, in small letters, with their marks.
float least_stages_width(const PanelContext& context) {
  const Fonts& fonts = context.theme.fonts;
  float label = 0.0F;
  const std::vector<io::ScanStage> tabs = offered_tabs(context.view);
  for (const io::ScanStage stage : tabs) {
    label = std::max(label, text_width(fonts.small, tab_label(context, stage)));
  }
  const float mark = text_width(fonts.strong, icon::kSaved) + context.px(kGapS);
  const auto count = static_cast<float>(tabs.size());
  return count * (std::ceil(label + mark) + context.px(24.0F)) +
         (count - 1.0F) * context.px(kGapXs);
}

void draw_stages(const PanelContext& context, Rect row) {
  const std::vector<io::ScanStage> tabs = offered_tabs(context.view);
  // A single tab need not fill the row.
  const auto count = static_cast<float>(std::max<std::size_t>(tabs.size(), 3));
  const float width = (row.width - (count - 1.0F) * context.px(kGapXs)) / count;
  for (const io::ScanStage stage : tabs) {
    const char* mark = mark_of(progress_of_group(stage, context.view));
    small_action(context, row.take_left(width, context.px(kGapXs)), action_of(stage),
                 {mark, tab_label(context, stage), false, kNeutral, false});
  }
}

struct Figure {
  Text label;
  const char* widest;  ///< of the values in half an hour
  Text hint;
};
constexpr std::array<Figure, 5> kFigures = {
    {{Text::kTime, "00:00", Text::kTimeHint},
     {Text::kViews, "00000", Text::kViewsHint},
     {Text::kRejected, "0000", Text::kRejectedHint},
     {Text::kDropped, "0000", Text::kDroppedHint},
     {Text::kWellCovered, "100 %", Text::kWellCoveredHint}}};
using FigureValues = std::array<std::string, kFigures.size()>;

FigureValues figure_values(const AppView& view) {
  if (view.scan == nullptr) return {"0:00", "0", "0", "0", "\u2013"};
  const scan::ScanSnapshot& scan = *view.scan;
  const bool has_surface = surfel_count(scan.model) > 0;
  return {clock_text(scan.scanned_s), fmt::format("{}", scan.view_count()),
          fmt::format("{}", scan.counts.rejected_count()), fmt::format("{}", scan.counts.skipped),
          has_surface ? fmt::format("{:.0f} %", 100.0 * scan.good_share) : "\u2013"};
}

/// Width of a figure and the gap to its neighbors, for its widest value: it never moves.
float figure_width(const PanelContext& context, const Figure& figure) {
  const Fonts& fonts = context.theme.fonts;
  return std::ceil(std::max(text_width(fonts.small, context.text(figure.label)),
                            text_width(fonts.title, figure.widest))) +
         2.0F * context.px(kGapXs);
}

float figures_width(const PanelContext& context) {
  float width = 0.0F;
  for (const Figure& figure : kFigures) width += figure_width(context, figure);
  return width;
}

void draw_scan_figures(const PanelContext& context, Rect row) {
  const FigureValues values = figure_values(context.view);
  const float spare =
      std::max(row.width - figures_width(context), 0.0F) / static_cast<float>(kFigures.size());
  for (std::size_t i = 0; i < kFigures.size(); ++i) {
    const Figure& figure = kFigures[i];
    Rect cell = row.take_left(figure_width(context, figure) + spare)
                    .inset(context.px(kGapXs), context.px(4.0F));
    context.places.set(fmt::format("figure_{}", i + 1), cell);
    hint_over(cell, context.text(figure.hint));
    const Rect value = cell.take_top(cell.height * 0.56F);
    draw_text(value, {context.theme.fonts.title, kText, Align::kCenter}, values[i]);
    draw_text(cell, {context.theme.fonts.small, kTextQuiet, Align::kCenter},
              context.text(figure.label));
  }
}

/// Only with real devices; colored when a device has a problem.
void draw_devices_button(const PanelContext& context, const Rect& box) {
  const bool has_problem = !context.view.devices->problems.empty();
  small_action(context, box, Action::kDevices, {icon::kDevice, "", has_problem, kCaution, false});
}

void draw_program_buttons(const PanelContext& context, Rect row) {
  const bool is_muted = context.view.settings.is_muted;
  const float side = row.height;
  small_action(context, row.take_right(side, context.px(kGapS)), Action::kSettings,
               {icon::kSettings, "", false, kNeutral, false});
  small_action(context, row.take_right(side, context.px(kGapS)), Action::kMute,
               {is_muted ? icon::kMuted : icon::kSound, "", false, kNeutral, false});
  if (context.view.devices) draw_devices_button(context, row);
}

/// Squares as high as the bar, with the gaps between them.
float program_buttons_width(const PanelContext& context, float height) {
  const float count = context.view.devices ? 3.0F : 2.0F;
  return count * height + (count - 1.0F) * context.px(kGapS);
}

}  // namespace

void draw_top_bar(const PanelContext& context) {
  const Plate plate("top", context.layout.top);
  Rect row = context.layout.top.inset(context.px(kGapM), context.px(kGapS));
  const float gap = context.px(kGapM);
  draw_program_buttons(context, row.take_right(program_buttons_width(context, row.height), gap));
  // A long name may be cut, a figure may not: the case gets what is left, and at least the width
  // that its state needs.
  const float figures = figures_width(context) + 2.0F * gap;
  const float stages = std::clamp(row.width - figures - case_width(context),
                                  std::min(least_stages_width(context), context.px(kStagesWidth)),
                                  context.px(kStagesWidth));
  const float others = stages + figures;
  draw_case(context, row.take_left(std::clamp(row.width - others, 0.0F, context.px(232.0F)), gap));
  draw_stages(context, row.take_left(stages, gap).inset(0.0F, context.px(2.0F)));
  const float width = std::min(row.width, context.px(400.0F));
  draw_scan_figures(context, row.centered(width, row.height));
}

}  // namespace flytri::ui
