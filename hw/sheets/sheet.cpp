#include "hw/sheets/sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

namespace flytri::sheets {
namespace {

using drawing::Drawing;
using drawing::TextAlign;

// Printers leave about 5 mm of each border white.
constexpr double kMargin_mm = 10.0;
constexpr double kTitle_mm = 5.0;
constexpr double kNote_mm = 2.8;
constexpr double kNoteStep_mm = 4.2;
// Room for a ruler with its numbers.
constexpr double kRulerRoom_mm = 14.0;
constexpr double kThin_mm = 0.1;

struct PaperSize {
  std::string_view name;
  double width_mm, height_mm;
};
constexpr std::array<PaperSize, 5> kPapers = {{{"A4", 297.0, 210.0},
                                               {"A3", 420.0, 297.0},
                                               {"A2", 594.0, 420.0},
                                               {"A1", 841.0, 594.0},
                                               {"A0", 1189.0, 841.0}}};

double header_mm(std::size_t note_count) {
  return kTitle_mm + 2.0 + kNoteStep_mm * static_cast<double>(note_count);
}

/// A ruler with a tick for each millimeter, from `start_mm` along `along`, ticks towards `ticks`.
void draw_ruler(Drawing& page, const Vec2& start_mm, const Vec2& along, const Vec2& ticks) {
  page.line(start_mm, start_mm + kRuler_mm * along, kThin_mm);
  for (int mm = 0; mm <= static_cast<int>(kRuler_mm); ++mm) {
    const double length_mm = mm % 10 == 0 ? 4.0 : (mm % 5 == 0 ? 2.5 : 1.5);
    const Vec2 at = start_mm + mm * along;
    page.line(at, at + length_mm * ticks, kThin_mm);
  }
}

void number_ruler(Drawing& page, const Vec2& start_mm, const Vec2& along, const Vec2& ticks) {
  const bool is_upright = along.y() > 0.0;
  for (int mm = 0; mm <= static_cast<int>(kRuler_mm); mm += 20) {
    const Vec2 at = start_mm + mm * along + (is_upright ? 5.0 : 7.0) * ticks +
                    (is_upright ? Vec2(0.0, 0.9) : Vec2(0.0, 0.0));
    page.text(at, fmt::format("{}", mm),
              {.height_mm = 2.6, .align = is_upright ? TextAlign::kLeft : TextAlign::kMiddle});
  }
}

void draw_header(Drawing& page, const std::string& title, const std::vector<std::string>& notes) {
  Vec2 at(kMargin_mm, kMargin_mm + kTitle_mm - 1.0);
  page.text(at, title, {.height_mm = kTitle_mm});
  at.y() += 1.5;
  for (const std::string& note : notes) {
    at.y() += kNoteStep_mm;
    page.text(at, note, {.height_mm = kNote_mm});
  }
}

}  // namespace

Result<Sheet> start_sheet(const std::string& title, const std::vector<std::string>& notes,
                          const Vec2& content_mm) {
  std::vector<std::string> words = notes;
  words.push_back(
      fmt::format("Print at 100 %, without \"fit to page\". Check: both rulers must measure {:.2f} "
                  "mm with calipers, from the first to the last tick.",
                  kRuler_mm));
  const double top_mm = kMargin_mm + header_mm(words.size());
  const Vec2 used_mm(2.0 * kMargin_mm + kRulerRoom_mm, top_mm + kRulerRoom_mm + kMargin_mm);
  const Vec2 least_mm = content_mm.cwiseMax(kRuler_mm) + used_mm;
  const auto* const paper =
      std::find_if(kPapers.begin(), kPapers.end(), [&](const PaperSize& size) {
        return size.width_mm >= least_mm.x() && size.height_mm >= least_mm.y();
      });
  if (paper == kPapers.end()) {
    return fail(ErrorCode::kBadOption,
                "a sheet of {:.0f} x {:.0f} mm, with its rulers, is too large for A0; choose a "
                "smaller field or volume",
                least_mm.x(), least_mm.y());
  }
  const Vec2 size_mm(paper->width_mm, paper->height_mm);
  Sheet sheet{Drawing(size_mm), std::string(paper->name)};
  sheet.x_ruler_mm = {kMargin_mm + kRulerRoom_mm, top_mm + 4.0};
  sheet.y_ruler_mm = {kMargin_mm, top_mm + kRulerRoom_mm};
  const Vec2 room_mm = size_mm - used_mm;
  sheet.middle_mm = sheet.y_ruler_mm + Vec2(kRulerRoom_mm, 0.0) + 0.5 * room_mm;
  draw_header(sheet.drawing, title, words);
  draw_ruler(sheet.drawing, sheet.x_ruler_mm, Vec2::UnitX(), Vec2::UnitY());
  number_ruler(sheet.drawing, sheet.x_ruler_mm, Vec2::UnitX(), Vec2::UnitY());
  draw_ruler(sheet.drawing, sheet.y_ruler_mm, Vec2::UnitY(), Vec2::UnitX());
  number_ruler(sheet.drawing, sheet.y_ruler_mm, Vec2::UnitY(), Vec2::UnitX());
  return sheet;
}

}  // namespace flytri::sheets
