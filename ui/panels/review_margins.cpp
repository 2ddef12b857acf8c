/// @file  Margin lines in the side panel: the one that is being drawn, and those that are kept.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "ui/panels/review_parts.h"
#include "ui/state/review_look.h"
#include "ui/widgets/hint.h"
#include "ui/widgets/meter.h"

namespace flytri::ui {
namespace {

constexpr float kKeepRow = 40.0F, kMarginsHeading = 24.0F;

void draw_drawn(const PanelContext& context, Rect& rest, const review::Margin& margin) {
  value_row(context, rest, Text::kMarginLength, measured_mm_text(review::length_mm(margin.line)));
  const Rect across = {rest.x, rest.y, rest.width, context.px(24.0F)};
  value_row(context, rest, Text::kMarginAcross,
            fmt::format("± {}", length_text(review::sigma_rms_mm(margin.line))));
  hint_over(across, context.text(Text::kMarginAcrossHint));
  value_row(context, rest, Text::kMarginOnEdge, fmt::format("{:.0f} %", 100.0 * margin.edge_share));
  value_row(context, rest, Text::kMarginLeastTurn,
            fmt::format("{:.0f}°", margin.least_turn_rad * 180.0 / std::numbers::pi));
  rest.take_top(context.px(kGapS));
}

void draw_buttons(const PanelContext& context, Rect& rest) {
  Rect row = rest.take_top(context.px(kKeepRow), context.px(kGapM));
  const float width = std::floor((row.width - context.px(kGapXs)) * 0.6F);
  const bool can_keep = can_keep_margin(context.view, context.state);
  small_action(context, row.take_left(width, context.px(kGapXs)), Action::kConfirm,
               {.label = context.text(Text::kKeepMargin),
                .is_main = can_keep,
                .color = kGood,
                .shows_key = false});
  small_action(context, row, Action::kUndo, {.shows_key = false});
}

void draw_kept(const PanelContext& context, Rect& rest) {
  const auto& all = context.view.review.margins;
  if (all.empty()) return;
  draw_text(rest.take_top(context.px(kMarginsHeading), context.px(kGapXs)),
            {context.theme.fonts.strong, kText, Align::kLeft}, context.text(Text::kMargins));
  const std::size_t rows = std::min(all.size(), removable_rows(context, rest));
  for (std::size_t i = all.size() - rows; i < all.size(); ++i) {
    const Rect row = {rest.x, rest.y, rest.width, context.px(36.0F)};
    const std::string value = all[i].is_outdated
                                  ? context.text(Text::kMarginOutdated)
                                  : measured_mm_text(review::length_mm(all[i].margin->line));
    if (removable(
            context, rest,
            {fmt::format("remove_margin_{}", i + 1),
             context.view.texts.fill<Text::kMarginNumber>(i + 1), value, Text::kRemoveThisMargin}))
      context.commands.emplace_back(RemoveMargin{i});
    if (all[i].is_outdated) hint_over(row, context.text(Text::kMarginOutdatedHint));
  }
}

}  // namespace

void draw_margins(const PanelContext& context, Rect rest) {
  const ReviewState& review = context.view.review;
  const bool is_drawing = !context.state.review.margin_mm.empty();
  if (is_drawing && !failure_text(context, rest, Text::kNoMargin, review.margin_failure) &&
      review.drawn != nullptr)
    draw_drawn(context, rest, review.drawn->margin);
  if (is_drawing) draw_buttons(context, rest);
  draw_kept(context, rest);
}

}  // namespace flytri::ui
