#include "hw/sheets/target_sheets.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "core/base/check_options.h"
#include "hw/sheets/target_field.h"

namespace flytri::sheets {
namespace {

using calibration::DotTarget;
using drawing::Drawing;
using drawing::TextAlign;

// Room around a target for the marks of its middle.
constexpr double kMarkRoom_mm = 7.0;
constexpr double kMarkWidth_mm = 0.2;
// A board that is tilted or held aside must still fill the image.
constexpr double kHandBoardShare = 1.3;

Result<void> check_dots(const DotTarget& dots) {
  return OptionCheck("DotTarget")
      .positive("pitch_mm", dots.pitch_mm)
      .positive("diameter_mm", dots.diameter_mm)
      .above("marker_diameter_mm", dots.marker_diameter_mm, dots.diameter_mm)
      .must("marker_diameter_mm", dots.marker_diameter_mm, dots.marker_diameter_mm < dots.pitch_mm,
            "less than pitch_mm")
      .result();
}

/// Whole dots that fill the field.
struct DotRange {
  Eigen::Vector2i first, last;
  DotRange(const Field& field, double pitch_mm)
      : first((field.min() / pitch_mm).array().floor().cast<int>()),
        last((field.max() / pitch_mm).array().ceil().cast<int>()) {}
};

void draw_dots(Drawing& page, const Vec2& origin_mm, const DotRange& range, const DotTarget& dots) {
  for (int j = range.first.y(); j <= range.last.y(); ++j)
    for (int i = range.first.x(); i <= range.last.x(); ++i)
      page.disk(origin_mm + dots.pitch_mm * Vec2(i, j), 0.5 * dots.diameter_of(i, j));
}

/// Marks outside of the target where its axes x = 0 and y = 0 are.
void draw_axis_marks(TargetSheet& target) {
  Drawing& page = target.sheet.drawing;
  const Vec2& origin = target.sheet.middle_mm;
  const auto mark = [&](const Vec2& border, const Vec2& outward) {
    page.line(origin + border + 1.0 * outward, origin + border + 4.0 * outward, kMarkWidth_mm);
  };
  mark({0.0, target.least_mm.y()}, -Vec2::UnitY());
  mark({0.0, target.most_mm.y()}, Vec2::UnitY());
  mark({target.least_mm.x(), 0.0}, -Vec2::UnitX());
  mark({target.most_mm.x(), 0.0}, Vec2::UnitX());
  page.text(origin + Vec2(target.most_mm.x() + 4.5, 1.0), "x");
  page.text(origin + Vec2(0.0, target.most_mm.y() + 6.5), "y", {.align = TextAlign::kMiddle});
}

/// Places the origin so that the target lies in the middle of the sheet.
void center(TargetSheet& target) {
  target.sheet.middle_mm -= 0.5 * (target.least_mm + target.most_mm);
}

Vec2 room_for(const Vec2& size_mm) { return size_mm + Vec2::Constant(2.0 * kMarkRoom_mm); }

std::vector<std::string> dot_notes(const DotTarget& dots) {
  return {fmt::format("Dots every {:g} mm, diameter {:g} mm; the three large dots (0, 0), (1, 0) "
                      "and (0, 2): {:g} mm. x points to the right as the sensor sees it, y down.",
                      dots.pitch_mm, dots.diameter_mm, dots.marker_diameter_mm),
          fmt::format("If both rulers measure M instead, calibrate with --dots and these three "
                      "numbers times M / {:g}. If they differ by more than 0.1 mm, print again.",
                      kRuler_mm)};
}

/// An empty sheet on which the dots will fill the field.
Result<TargetSheet> start_dots(const char* title, const std::vector<std::string>& notes,
                               const DotTarget& dots, const Field& field) {
  if (auto good = check_dots(dots); !good) return tl::unexpected(good.error());
  const DotRange range(field, dots.pitch_mm);
  const Vec2 least_mm = dots.pitch_mm * (range.first.cast<double>() - Vec2::Ones());
  const Vec2 most_mm = dots.pitch_mm * (range.last.cast<double>() + Vec2::Ones());
  auto sheet = start_sheet(title, notes, room_for(most_mm - least_mm));
  if (!sheet) return tl::unexpected(sheet.error());
  TargetSheet target{*std::move(sheet), least_mm, most_mm};
  center(target);
  return target;
}

void finish_dots(TargetSheet& target, const DotTarget& dots, const Field& field) {
  const DotRange range(field, dots.pitch_mm);
  draw_dots(target.sheet.drawing, target.sheet.middle_mm, range, dots);
  target.sheet.drawing.fill(drawing::kBlack);
  draw_axis_marks(target);
}

}  // namespace

Result<TargetSheet> dot_sheet(const simulated::SensorModel& sensor, double z_mm) {
  const Field field = target_field(sensor, z_mm);
  auto target = start_dots("flytri: dot target", dot_notes(sensor.dots), sensor.dots, field);
  if (!target) return target;
  Drawing& page = target->sheet.drawing;
  page.box(target->sheet.middle_mm + target->least_mm, target->most_mm - target->least_mm);
  finish_dots(*target, sensor.dots, field);
  return target;
}

Result<TargetSheet> hand_board_sheet(const simulated::SensorModel& sensor, double z_mm) {
  const DotTarget dots = sensor.board_dots();
  std::vector<std::string> notes = dot_notes(dots);
  notes.emplace_back(
      "For flytri calibrate --live --by-hand. Glue it on a flat plate: it may bend by a few "
      "micrometers only.");
  const Field seen = target_field(sensor, z_mm);
  const Field field(kHandBoardShare * seen.min(), kHandBoardShare * seen.max());
  auto target = start_dots("flytri: dotted board", notes, dots, field);
  if (target) finish_dots(*target, dots, field);
  return target;
}

Result<TargetSheet> board_sheet(const simulated::SensorModel& sensor, double z_mm) {
  const Field field = target_field(sensor, z_mm);
  auto sheet = start_sheet(
      "flytri: white board",
      {"The white plane of flytri calibrate --live and --check. Print on matt white paper and glue "
       "it on a flat plate: the plane may bend by a few micrometers only.",
       fmt::format("The camera sees less than the frame ({:.0f} x {:.0f} mm) at all depths. Keep "
                   "the inside clean and white.",
                   field.sizes().x(), field.sizes().y())},
      room_for(field.sizes()));
  if (!sheet) return tl::unexpected(sheet.error());
  TargetSheet target{*std::move(sheet), field.min(), field.max()};
  center(target);
  // The frame lies outside of the field.
  const Vec2 border = Vec2::Constant(kMarkWidth_mm);
  target.sheet.drawing
      .box(target.sheet.middle_mm + target.least_mm - border, field.sizes() + 2.0 * border)
      .stroke(kMarkWidth_mm);
  draw_axis_marks(target);
  return target;
}

}  // namespace flytri::sheets
