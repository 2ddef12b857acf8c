/// @file  Holes of the surface and measured distances.
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "ui/panels/panels.h"
#include "ui/state/camera_moves.h"
#include "ui/state/jaw_words.h"
#include "ui/state/jaws_look.h"
#include "ui/state/review_look.h"
#include "ui/theme/icons.h"
#include "ui/widgets/meter.h"

namespace flytri::ui {
namespace {

constexpr float kHoleWidth = 272.0F, kMostHoleWidth = 352.0F;
constexpr float kDistanceWidth = 232.0F;
constexpr float kRow = 40.0F;
constexpr float kHeading = 24.0F;
constexpr std::size_t kMostRows = 3;

/// What the button of a hole says.
std::string hole_label(const PanelContext& context, std::size_t index) {
  const scan::ScanSnapshot& scan = *context.view.scan;
  return hole_text(scan.holes[index], scan.jaw ? &*scan.jaw : nullptr, jaw_of(context.view.stage),
                   context.view.texts);
}

/// As wide as the labels of the listed holes need, in units.
float hole_width(const PanelContext& context, std::size_t listed) {
  float width = kHoleWidth;
  for (std::size_t i = 0; i < listed; ++i) {
    const float label = text_width(context.theme.fonts.strong, hole_label(context, i));
    width = std::max(width, label / context.theme.scale + 2.0F * (kGapS + 12.0F) + 1.0F);
  }
  return std::min(width, kMostHoleWidth);
}

/// Height of a plate with a heading and rows, in units.
float plate_height(float rows) { return 2.0F * kGapS + kHeading + (kRow + kGapXs) * rows; }

/// A plate at the lower left, as high as a heading and its rows.
Rect plate_box(const PanelContext& context, float width, std::size_t rows) {
  const float height = context.px(plate_height(static_cast<float>(rows)));
  const Rect& picture = context.layout.picture;
  const float margin = context.px(kGapM);
  return {picture.x + margin, picture.bottom() - margin - height, context.px(width), height};
}

/// How many findings are listed: as many as fit below the colors, with `others` more rows below
/// them. The plate has at least one row.
std::size_t listed_rows(const PanelContext& context, std::size_t findings, std::size_t others) {
  const float room = context.layout.picture.bottom() - colors_box(context).bottom() -
                     context.px(kGapM + kGapXs + plate_height(0.0F));
  const auto fitting = static_cast<std::size_t>(std::max(1.0F, room / context.px(kRow + kGapXs)));
  return std::min({findings, kMostRows, fitting - std::min(others, fitting)});
}

void draw_heading(const PanelContext& context, Rect& rest, const std::string& text) {
  draw_text(rest.take_top(context.px(kHeading)), {context.theme.fonts.strong, kText, Align::kLeft},
            text);
}

void draw_holes(const PanelContext& context, Rect& rest, std::size_t listed) {
  const scan::ScanSnapshot& scan = *context.view.scan;
  const std::vector<meshing::BoundaryLoop>& holes = scan.holes;
  const auto& selected = context.state.selected_hole;
  const Texts& texts = context.view.texts;
  const auto count = static_cast<std::int64_t>(holes.size());
  draw_heading(context, rest,
               scan.holes_are_current ? texts.count<Text::kHoles>(count)
                                      : texts.count<Text::kHolesSoFar>(count));
  for (std::size_t i = 0; i < listed; ++i) {
    const std::string id = fmt::format("hole_{}", i + 1);
    ButtonLook look;
    look.id = id.c_str();
    look.label = hole_label(context, i);
    look.is_on = selected && selected->index == i;
    const Rect box = rest.take_top(context.px(kRow), context.px(kGapXs));
    context.places.set(id, box);
    if (small_button(context.theme, box, look)) show_hole(context.view, i, context.state);
  }
  small_action(context, rest.take_top(context.px(kRow), context.px(kGapXs)), Action::kNextHole,
               {icon::kNext});
}

void draw_measurements(const PanelContext& context, Rect& rest, std::size_t listed) {
  const auto& all = context.view.measurements;
  draw_heading(context, rest, context.text(Text::kDistances));
  for (std::size_t i = all.size() - listed; i < all.size(); ++i) {
    Rect row = rest.take_top(context.px(kRow), context.px(kGapXs));
    const std::string id = fmt::format("remove_distance_{}", i + 1);
    ButtonLook look;
    look.id = id.c_str();
    look.icon = icon::kTrash;
    look.hint = context.text(Text::kRemoveThisDistance);
    const Rect box = row.take_right(row.height, context.px(kGapS));
    context.places.set(id, box);
    if (small_button(context.theme, box, look)) {
      context.commands.emplace_back(RemoveMeasurement{i});
    }
    labeled_value(context.theme, row, context.view.texts.fill<Text::kDistanceNumber>(i + 1),
                  fmt::format("{:.2f} mm", (all[i].to_mm - all[i].from_mm).norm()));
  }
}

/// Only one kind is listed at a time.
enum class Findings { kNone, kHoles, kDistances };

Findings findings_of(const PanelContext& context) {
  const scan::ScanPhase phase = context.phase();
  if (phase == scan::ScanPhase::kContinuation || phase == scan::ScanPhase::kFinishing)
    return Findings::kNone;
  const bool has_holes = context.view.scan != nullptr && !context.view.scan->holes.empty();
  const bool has_distances = !context.view.measurements.empty();
  // Distances while measuring, or if there are no holes.
  const bool measures = context.state.tool == Tool::kMeasure;
  if (has_distances && (measures || !has_holes)) return Findings::kDistances;
  return has_holes ? Findings::kHoles : Findings::kNone;
}

struct FindingsPlate {
  const char* id;
  Rect box;
  std::size_t listed = 0;
  void (*draw)(const PanelContext& context, Rect& rest, std::size_t listed);
};

std::optional<FindingsPlate> findings_plate(const PanelContext& context) {
  // They are about the bite scan.
  if (shown_jaws(context.view, context.state) != nullptr) return std::nullopt;
  // The side panel lists what was measured.
  if (is_reviewing(context.view, context.state)) return std::nullopt;
  switch (findings_of(context)) {
    case Findings::kHoles: {
      // One row for the button to the next hole.
      const std::size_t listed = listed_rows(context, context.view.scan->holes.size(), 1);
      return FindingsPlate{"holes", plate_box(context, hole_width(context, listed), listed + 1),
                           listed, draw_holes};
    }
    case Findings::kDistances: {
      const std::size_t listed = listed_rows(context, context.view.measurements.size(), 0);
      return FindingsPlate{"distances", plate_box(context, kDistanceWidth, listed), listed,
                           draw_measurements};
    }
    case Findings::kNone:
      break;
  }
  return std::nullopt;
}

}  // namespace

std::optional<Rect> findings_box(const PanelContext& context) {
  const auto plate = findings_plate(context);
  return plate ? std::optional(plate->box) : std::nullopt;
}

void draw_findings_panel(const PanelContext& context) {
  const auto findings = findings_plate(context);
  if (!findings) return;
  const Plate plate(findings->id, findings->box, overlay(context.theme));
  Rect rest = findings->box.inset(context.px(kGapS));
  findings->draw(context, rest, findings->listed);
}

}  // namespace flytri::ui
