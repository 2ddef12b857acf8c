/// @file  What was found on the surface: its holes and the measured distances.
#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "ui/camera_moves.h"
#include "ui/panels/panels.h"
#include "ui/theme/icons.h"
#include "ui/widgets/meter.h"

namespace flytri::ui {
namespace {

constexpr float kHoleWidth = 168.0F;
constexpr float kDistanceWidth = 232.0F;
constexpr float kRow = 40.0F;
constexpr float kHeading = 24.0F;
constexpr std::size_t kMostRows = 3;

/// A plate at the lower left, grown upwards by its rows and a heading.
Rect plate_box(const PanelContext& context, float width, std::size_t rows) {
  const float height =
      context.px(2.0F * kGapS + kHeading + (kRow + kGapXs) * static_cast<float>(rows));
  const Rect& picture = context.layout.picture;
  const float margin = context.px(kGapM);
  return {picture.x + margin, picture.bottom() - margin - height, context.px(width), height};
}

/// As many rows as there is room for below the colors, one at least.
std::size_t rows_that_fit(const PanelContext& context, std::size_t wanted) {
  const float room = context.layout.picture.bottom() - colors_box(context).bottom() -
                     context.px(kGapM + kGapXs + 2.0F * kGapS + kHeading);
  const float fitting = std::max(1.0F, room / context.px(kRow + kGapXs));
  return std::min(wanted, static_cast<std::size_t>(fitting));
}

void draw_heading(const PanelContext& context, Rect& rest, const std::string& text) {
  draw_text(rest.take_top(context.px(kHeading)), {context.theme.fonts.strong, kText, Align::kLeft},
            text);
}

std::string hole_text(const BoundaryLoop& hole) {
  return fmt::format("{:.1f} mm wide", hole.width_mm);
}

void draw_holes(const PanelContext& context, Rect& rest, std::size_t listed) {
  const ScanSnapshot& scan = *context.view.scan;
  const std::vector<BoundaryLoop>& holes = scan.holes;
  const auto& selected = context.state.selected_hole;
  draw_heading(context, rest,
               fmt::format("{} {}{}", holes.size(), holes.size() == 1 ? "hole" : "holes",
                           scan.holes_are_current ? "" : " so far"));
  for (std::size_t i = 0; i < listed; ++i) {
    const std::string id = fmt::format("hole_{}", i + 1);
    ButtonLook look;
    look.id = id.c_str();
    look.label = hole_text(holes[i]);
    look.is_on = selected && selected->index == i;
    look.color = kCaution;
    const Rect box = rest.take_top(context.px(kRow), context.px(kGapXs));
    context.places.set(id, box);
    if (small_button(context.theme, box, look)) show_hole(context.view, i, context.state);
  }
  small_action(context, rest.take_top(context.px(kRow), context.px(kGapXs)), Action::kNextHole,
               {icon::kNext, "Next hole"});
}

void draw_measurements(const PanelContext& context, Rect& rest, std::size_t listed) {
  const auto& all = context.view.measurements;
  draw_heading(context, rest, "Distances");
  for (std::size_t i = all.size() - listed; i < all.size(); ++i) {
    Rect row = rest.take_top(context.px(kRow), context.px(kGapXs));
    const std::string id = fmt::format("remove_distance_{}", i + 1);
    ButtonLook look;
    look.id = id.c_str();
    look.icon = icon::kTrash;
    look.hint = "Remove this distance";
    const Rect box = row.take_right(row.height, context.px(kGapS));
    context.places.set(id, box);
    if (small_button(context.theme, box, look)) {
      context.commands.emplace_back(RemoveMeasurement{i});
    }
    labeled_value(context.theme, row, fmt::format("Distance {}", i + 1),
                  fmt::format("{:.2f} mm", (all[i].to_mm - all[i].from_mm).norm()));
  }
}

void draw_hole_plate(const PanelContext& context) {
  const std::size_t rows =
      rows_that_fit(context, std::min(context.view.scan->holes.size(), kMostRows) + 1);
  const Rect box = plate_box(context, kHoleWidth, rows);
  const Plate plate("holes", box, overlay(context.theme));
  Rect rest = box.inset(context.px(kGapS));
  draw_holes(context, rest, rows - 1);
}

void draw_measurement_plate(const PanelContext& context) {
  const std::size_t rows =
      rows_that_fit(context, std::min(context.view.measurements.size(), kMostRows));
  const Rect box = plate_box(context, kDistanceWidth, rows);
  const Plate plate("distances", box, overlay(context.theme));
  Rect rest = box.inset(context.px(kGapS));
  draw_measurements(context, rest, rows);
}

}  // namespace

void draw_findings_panel(const PanelContext& context) {
  const ScanPhase phase = context.phase();
  if (phase == ScanPhase::kContinuation || phase == ScanPhase::kFinishing) return;
  const bool measures = context.state.tool == Tool::kMeasure;
  const bool has_holes = context.view.scan != nullptr && !context.view.scan->holes.empty();
  // One at a time: distances while they are measured, or where there are no holes to close.
  if (!context.view.measurements.empty() && (measures || !has_holes)) {
    draw_measurement_plate(context);
  } else if (has_holes) {
    draw_hole_plate(context);
  }
}

}  // namespace flytri::ui
