#include "ui/panels/calibration_cards.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ui/theme/icons.h"
#include "ui/widgets/badge.h"

namespace flytri::ui {
namespace {

constexpr float kLabelRow = 18.0F;
constexpr float kCell = 40.0F;
constexpr float kWidestCell = 190.0F;
constexpr float kNameColumn = 88.0F;
constexpr float kShotRow = 24.0F;
constexpr float kTableRow = 44.0F;
constexpr double kMicrons = 1e3;

std::size_t count_of(const RunningCalibration& running, std::size_t CalibrationPlace::*index) {
  std::size_t count = 0;
  for (const CalibrationPlace& place : running.places) count = std::max(count, place.*index + 1);
  return count;
}

/// The next place is outlined, a finished one is filled; a click on it takes its images again.
void draw_cell(const PanelContext& context, const Rect& box, const RunningCalibration& running,
               std::size_t index) {
  const CalibrationPlace& place = running.places[index];
  const bool is_waiting =
      running.step == CalibrationStep::kTarget || running.step == CalibrationStep::kRefused;
  const std::string id = fmt::format("place_of_target_{}", index + 1);
  const float rounding = context.px(kGapXs);
  draw_box(box, place.is_done ? mix(kRaised, kGood, 0.45F) : kRaised, rounding);
  if (running.wanted == index) draw_outline(box, kNeutral, context.px(3.0F), rounding);
  if (place.is_done) {
    draw_text(box, {context.theme.fonts.strong, kText, Align::kCenter}, icon::kFinish);
  }
  context.places.set(id, box);
  if (touch_area(id.c_str(), box) && is_waiting && place.is_done) {
    context.commands.emplace_back(RetakeCalibrationPlace{index});
  }
  if (is_waiting && place.is_done && ImGui::IsItemHovered()) {
    const std::string hint = context.view.texts.fill<Text::kTakeAgain>(place.target, place.where);
    ImGui::SetTooltip("%s", hint.c_str());
  }
}

/// Left of each row.
void draw_row_names(const PanelContext& context, const Rect& box,
                    const RunningCalibration& running) {
  for (const CalibrationPlace& place : running.places) {
    if (place.column != 0) continue;
    const float top =
        box.y + context.px(kLabelRow) + static_cast<float>(place.row) * context.px(kCell + kGapXs);
    draw_text({box.x, top, box.width, context.px(kCell)},
              {context.theme.fonts.small, kTextQuiet, Align::kLeft}, place.target);
  }
}

void draw_judgement(const PanelContext& context, Rect& rest, const JudgedShot& shot) {
  const Fonts& fonts = context.theme.fonts;
  Rect row = rest.take_top(context.px(kShotRow));
  draw_text(row.take_left(context.px(20.0F), context.px(kGapXs)),
            {fonts.body, shot.is_good ? kGood : kCaution, Align::kLeft},
            shot.is_good ? icon::kSaved : icon::kWarning);
  draw_text(row.take_left(context.px(176.0F), context.px(kGapXs)),
            {fonts.strong, kText, Align::kLeft}, shot.name);
  if (shot.is_good) {
    draw_text(row, {fonts.small, kTextQuiet, Align::kLeft}, shot.finding);
    return;
  }
  rest.take_left(context.px(24.0F));
  for (const auto& [text, color] :
       {std::pair{sentence(shot.finding), kText}, {shot.remedy, kCaution}}) {
    if (text.empty()) continue;
    const float height = wrapped_height(fonts.body, rest.width, text);
    draw_wrapped(rest.take_top(height, context.px(kGapXs)), {fonts.body, color}, text);
  }
}

/// The largest offset in the chart.
double chart_range_mm(const CalibrationOutcome& outcome) {
  double range_mm = outcome.plane_limit_mm;
  for (const calibration::PlaneResidual& plane : outcome.planes) {
    for (const double offset_mm : plane.offset_mm) {
      range_mm = std::max(range_mm, std::abs(offset_mm));
    }
  }
  return 1.1 * range_mm;
}

/// From depth and offset to the screen.
struct Chart {
  Rect box;
  double near_mm, far_mm, range_mm;
  [[nodiscard]] ImVec2 at(double z_mm, double offset_mm) const {
    const double along = (z_mm - near_mm) / std::max(far_mm - near_mm, 1e-9);
    return {box.x + box.width * static_cast<float>(along),
            box.y + box.height * static_cast<float>(0.5 - 0.5 * offset_mm / range_mm)};
  }
};

void draw_level(const PanelContext& context, const Chart& chart, double offset_mm,
                const Color& color) {
  const ImVec2 from = chart.at(chart.near_mm, offset_mm), to = chart.at(chart.far_mm, offset_mm);
  ImGui::GetWindowDrawList()->AddLine(from, to, to_u32(color), context.px(1.0F));
  const float height = context.px(kLabelRow);
  draw_text({chart.box.x - context.px(64.0F), from.y - height / 2.0F, context.px(56.0F), height},
            {context.theme.fonts.small, kTextQuiet, Align::kRight},
            offset_mm == 0.0 ? "0 \u00b5m" : fmt::format("{:+.0f} \u00b5m", kMicrons * offset_mm));
}

void draw_offsets(const PanelContext& context, const Chart& chart,
                  const std::vector<calibration::PlaneResidual>& planes) {
  constexpr std::array<Color, 2> kInk = {kVerticalProfile, kHorizontalProfile};
  ImDrawList& list = *ImGui::GetWindowDrawList();
  for (std::size_t pattern = 0; pattern < kInk.size(); ++pattern) {
    for (const calibration::PlaneResidual& plane : planes) {
      list.PathLineTo(chart.at(plane.z_mm, plane.offset_mm[pattern]));
    }
    list.PathStroke(to_u32(with_opacity(kInk[pattern], 0.6F)), 0, context.px(1.5F));
    for (const calibration::PlaneResidual& plane : planes) {
      list.AddCircleFilled(chart.at(plane.z_mm, plane.offset_mm[pattern]), context.px(3.5F),
                           to_u32(kInk[pattern]));
    }
  }
}

void draw_planes(const PanelContext& context, Rect box, const CalibrationOutcome& outcome) {
  const Fonts& fonts = context.theme.fonts;
  draw_text(box.take_top(context.px(kShotRow), context.px(kGapS)),
            {fonts.strong, kNeutral, Align::kLeft}, context.text(Text::kPositionErrors));
  const std::array<LegendRow, 2> lines = {
      {{kVerticalProfile, context.text(Text::kLegendVertical)},
       {kHorizontalProfile, context.text(Text::kLegendHorizontal)}}};
  Rect below = box.take_bottom(context.px(64.0F));
  draw_box(box, kBackground, context.px(kRounding));
  Rect inner = box.inset(context.px(kGapM));
  inner.take_left(context.px(56.0F));
  const Chart chart = {inner, outcome.planes.front().z_mm, outcome.planes.back().z_mm,
                       chart_range_mm(outcome)};
  draw_level(context, chart, 0.0, kHairline);
  for (const double sign : {-1.0, 1.0}) {
    draw_level(context, chart, sign * outcome.plane_limit_mm, with_opacity(kCaution, 0.7F));
  }
  draw_offsets(context, chart, outcome.planes);
  Rect axis = below.take_top(context.px(kLabelRow));
  axis.take_left(inner.x - axis.x);
  axis.take_right(context.px(kGapM));
  draw_text(axis, {fonts.small, kTextQuiet, Align::kLeft},
            fmt::format("z {:+.1f} mm", chart.near_mm));
  draw_text(axis, {fonts.small, kTextQuiet, Align::kRight},
            fmt::format("{:+.1f} mm", chart.far_mm));
  legend(context.theme, below, lines);
}

void draw_figure(const PanelContext& context, Rect row,
                 const calibration::VerificationFigure& figure) {
  const Fonts& fonts = context.theme.fonts;
  const Color ink = figure.good() ? kGood : kBad;
  Rect words = row.take_top(context.px(kShotRow));
  draw_text(words.take_right(context.px(184.0F)), {fonts.strong, ink, Align::kRight},
            context.view.texts.fill<Text::kDeviationOfLimit>(
                kMicrons * std::abs(figure.deviation_mm), kMicrons * figure.limit_mm));
  draw_text(words, {fonts.body, kText, Align::kLeft}, context.view.texts.translated(figure.name));
  // From 0 in the middle to the limit at either end.
  const Rect bar = row.take_top(context.px(6.0F));
  draw_box(bar, kRaised, bar.height / 2.0F);
  const double share = std::clamp(figure.deviation_mm / std::max(figure.limit_mm, 1e-9), -1.0, 1.0);
  const float half = bar.width / 2.0F,
              length = std::max(std::abs(static_cast<float>(share)) * half, context.px(2.0F));
  draw_box({share < 0.0 ? bar.x + half - length : bar.x + half, bar.y, length, bar.height}, ink,
           0.0F);
}

}  // namespace

float calibration_places_height(const PanelContext& context, const RunningCalibration& running) {
  const auto rows = static_cast<float>(count_of(running, &CalibrationPlace::row));
  return running.places.empty() ? 0.0F : context.px(kLabelRow) + rows * context.px(kCell + kGapXs);
}

void draw_calibration_places(const PanelContext& context, Rect box,
                             const RunningCalibration& running) {
  if (running.places.empty()) return;
  draw_row_names(context, box.take_left(context.px(kNameColumn)), running);
  const auto columns = static_cast<float>(count_of(running, &CalibrationPlace::column));
  const float step = std::min(box.width / columns, context.px(kWidestCell));
  for (std::size_t i = 0; i < running.places.size(); ++i) {
    const CalibrationPlace& place = running.places[i];
    const float left = box.x + static_cast<float>(place.column) * step;
    const float width = step - context.px(kGapXs);
    if (place.row == 0) {
      draw_text({left, box.y, width, context.px(kLabelRow)},
                {context.theme.fonts.small, kTextQuiet, Align::kCenter}, place.label);
    }
    const float top =
        box.y + context.px(kLabelRow) + static_cast<float>(place.row) * context.px(kCell + kGapXs);
    draw_cell(context, {left, top, width, context.px(kCell)}, running, i);
  }
}

void draw_judged_shots(const PanelContext& context, Rect box, const RunningCalibration& running) {
  for (const JudgedShot& shot : running.shots) draw_judgement(context, box, shot);
}

void draw_outcome(const PanelContext& context, Rect box, const CalibrationOutcome& outcome) {
  if (!outcome.planes.empty()) return draw_planes(context, box, outcome);
  draw_text(box.take_top(context.px(kShotRow), context.px(kGapS)),
            {context.theme.fonts.strong, kNeutral, Align::kLeft}, context.text(Text::kDeviations));
  const auto count = static_cast<float>(std::max<std::size_t>(outcome.figures.size(), 1));
  const float row = std::min(context.px(kTableRow), box.height / count);
  for (const calibration::VerificationFigure& figure : outcome.figures) {
    draw_figure(context, box.take_top(row), figure);
  }
}

}  // namespace flytri::ui
