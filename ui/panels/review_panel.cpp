/// @file  The side panel while a finished model is measured: the ways to measure, and the numbers.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "ui/panels/panels.h"
#include "ui/panels/review_parts.h"
#include "ui/state/review_look.h"
#include "ui/widgets/hint.h"

namespace flytri::ui {
namespace {

constexpr float kModeRow = 36.0F;

void draw_review_modes(const PanelContext& context, Rect& rest) {
  constexpr std::array<std::array<Action, 2>, 2> kPairs = {
      {{Action::kMeasureDistance, Action::kMeasureAngle}, {Action::kSection, Action::kUndercut}}};
  for (const auto& [left, right] : kPairs) {
    Rect row = rest.take_top(context.px(kModeRow), context.px(kGapXs));
    const float width = std::floor((row.width - context.px(kGapXs)) / 2.0F);
    small_action(context, row.take_left(width, context.px(kGapXs)), left, {.shows_key = false});
    small_action(context, row, right, {.shows_key = false});
  }
  small_action(context, rest.take_top(context.px(kModeRow), context.px(kGapM)), Action::kMargin,
               {.shows_key = false});
}

void draw_distances(const PanelContext& context, Rect rest) {
  const auto& all = context.view.measurements;
  const auto& known = context.view.review.distances_mm;
  const std::size_t rows = std::min(all.size(), removable_rows(context, rest));
  for (std::size_t i = all.size() - rows; i < all.size(); ++i) {
    const std::string value = i < known.size() ? measured_mm_text(known[i]) : "…";
    if (removable(context, rest,
                  {fmt::format("remove_distance_{}", i + 1),
                   context.view.texts.fill<Text::kDistanceNumber>(i + 1), value,
                   Text::kRemoveThisDistance}))
      context.commands.emplace_back(RemoveMeasurement{i});
  }
}

void draw_angles(const PanelContext& context, Rect rest) {
  const auto& all = context.view.review.angles_rad;
  const std::size_t rows = std::min(all.size(), removable_rows(context, rest));
  for (std::size_t i = all.size() - rows; i < all.size(); ++i) {
    if (removable(context, rest,
                  {fmt::format("remove_angle_{}", i + 1),
                   context.view.texts.fill<Text::kAngleNumber>(i + 1),
                   measured_angle_text(all[i].measured), Text::kRemoveThisAngle}))
      context.commands.emplace_back(RemoveAngle{i});
  }
}

void draw_review_mode(const PanelContext& context, const Rect& rest) {
  switch (context.state.review.mode) {
    case ReviewMode::kDistance:
      return draw_distances(context, rest);
    case ReviewMode::kAngle:
      return draw_angles(context, rest);
    case ReviewMode::kSection:
      return draw_section(context, rest);
    case ReviewMode::kUndercut:
      return draw_undercut(context, rest);
    case ReviewMode::kMargin:
      return draw_margins(context, rest);
  }
}

}  // namespace

void draw_review(const PanelContext& context, const Rect& box) {
  Rect rest = box;
  Rect heading = rest.take_top(context.px(24.0F), context.px(kGapS));
  hint_over(heading, context.text(Text::kReviewHint));
  if (context.view.review.is_running) {
    const char* text = context.text(Text::kComputing);
    const float width = std::ceil(text_width(context.theme.fonts.small, text)) + 1.0F;
    draw_text(heading.take_right(width, context.px(kGapS)),
              {context.theme.fonts.small, kCaution, Align::kRight}, text);
  }
  draw_text(heading, {context.theme.fonts.title, kText, Align::kLeft},
            context.text(Text::kMeasure));
  draw_review_modes(context, rest);
  draw_review_mode(context, rest);
}

}  // namespace flytri::ui
