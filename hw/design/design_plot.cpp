#include "hw/design/design_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "hw/drawing/ticks.h"

namespace flytri::design {
namespace {

using drawing::Color;
using drawing::Drawing;
using drawing::TextAlign;

constexpr Color kCurve{0.05, 0.35, 0.65};
constexpr Color kSecondCurve{0.80, 0.40, 0.05};
constexpr Color kGrid{0.85, 0.85, 0.85};
constexpr double kPlotMicronsOfMm = 1e3;
const Vec2 kPanel_mm(44.0, 30.0);
const Vec2 kPanelStep_mm(56.0, 42.0);
const Vec2 kCorner_mm(26.0, 26.0);

/// A result: one or two curves.
struct Row {
  std::string_view name, unit;
  std::string_view first, second;  ///< names of the curves; empty: there is none
  double (*value)(const DesignFigures&);
  double (*second_value)(const DesignFigures&);
};

const std::array<Row, 4> kPlotRows = {
    {{"uncertainty", "along the normal, µm", "far end", "near end",
      [](const DesignFigures& f) { return kPlotMicronsOfMm * f.depths[2].line.deviation_mm; },
      [](const DesignFigures& f) { return kPlotMicronsOfMm * f.depths[0].line.deviation_mm; }},
     {"least distance", "of grooves, mm", "along lines", "across lines",
      [](const DesignFigures& f) { return f.depths[1].grooves_along_lines_mm; },
      [](const DesignFigures& f) { return f.depths[1].grooves_across_lines_mm; }},
     {"depth of focus", "mm", "", "",
      [](const DesignFigures& f) { return f.focus.most_mm - f.focus.least_mm; }, nullptr},
     {"gap between", "unique areas, px", "vertical", "horizontal",
      [](const DesignFigures& f) { return f.patterns[0].areas.gap_px; },
      [](const DesignFigures& f) { return f.patterns[1].areas.gap_px; }}}};

struct Range {
  double least = 0.0, most = 0.0;
};

/// All values of a row; from 0, so that curves of different columns can be compared.
Range range_of(const Row& row, const std::vector<Sweep>& sweeps) {
  Range range;
  for (const Sweep& sweep : sweeps)
    for (const SweepPoint& point : sweep.points) {
      for (const auto value : {row.value, row.second_value}) {
        if (value == nullptr) continue;
        range.least = std::min(range.least, value(point.figures));
        range.most = std::max(range.most, value(point.figures));
      }
    }
  return range;
}

/// One panel: places of values on the page.
class Panel {
 public:
  Panel(const Vec2& corner_mm, const Range& range) : corner_mm_(corner_mm), range_(range) {}

  /// @param factor  0.5..2, on a logarithmic axis
  [[nodiscard]] Vec2 at(double factor, double value) const {
    const double x = 0.5 + 0.5 * std::log2(factor);
    const double y = (value - range_.least) / (range_.most - range_.least);
    return corner_mm_ + kPanel_mm.cwiseProduct(Vec2(x, 1.0 - y));
  }
  void draw_axes(Drawing& page, bool is_first) const {
    const double step = drawing::tick_step(range_.most - range_.least);
    for (double value = std::ceil(range_.least / step) * step; value <= range_.most;
         value += step) {
      page.line(at(0.5, value), at(2.0, value), 0.1, kGrid);
      if (is_first)
        page.text(at(0.5, value) + Vec2(-1.0, 0.9), fmt::format("{:.4g}", value + 0.0),
                  {.height_mm = 2.6, .align = TextAlign::kRight});
    }
    if (range_.least < 0.0) page.line(at(0.5, 0.0), at(2.0, 0.0), 0.25, drawing::kGray);
    page.box(corner_mm_, kPanel_mm).stroke(0.2);
  }
  /// @param scale  of the line's width: the second curve is thin, so that it hides no other
  void draw_curve(Drawing& page, const Sweep& sweep, double (*value)(const DesignFigures&),
                  const Color& color, double scale) const {
    std::vector<Vec2> places;
    for (const SweepPoint& point : sweep.points)
      places.push_back(at(point.factor, value(point.figures)));
    page.polyline(places).stroke(scale * 0.8, color);
    for (std::size_t i = 0; i < places.size(); ++i)
      page.disk(places[i], scale * (sweep.points[i].factor == 1.0 ? 1.3 : 0.8)).fill(color);
  }

 private:
  Vec2 corner_mm_;
  Range range_;
};

void draw_row_name(Drawing& page, const Row& row, double top_mm) {
  const double middle_mm = top_mm + 0.5 * kPanel_mm.y();
  page.text({9.0, middle_mm}, row.name,
            {.height_mm = 2.8, .align = TextAlign::kMiddle, .upwards = true});
  page.text({13.0, middle_mm}, row.unit,
            {.height_mm = 2.8, .align = TextAlign::kMiddle, .upwards = true});
  if (row.first.empty()) return;
  const double x_mm = kCorner_mm.x() + 4.0 * kPanelStep_mm.x() - 9.0;
  page.text({x_mm, top_mm + 8.0}, row.first, {.height_mm = 2.8, .color = kCurve});
  page.text({x_mm, top_mm + 13.0}, row.second, {.height_mm = 2.8, .color = kSecondCurve});
}

void draw_column(Drawing& page, const Sweep& sweep, double left_mm) {
  const std::string unit(unit_of(sweep.knob));
  page.text({left_mm + 0.5 * kPanel_mm.x(), kCorner_mm.y() - 3.0},
            fmt::format("{}{}{}", to_string(sweep.knob), unit.empty() ? "" : ", ", unit),
            {.height_mm = 3.2, .align = TextAlign::kMiddle});
  const double below_mm = kCorner_mm.y() + 3.0 * kPanelStep_mm.y() + kPanel_mm.y() + 4.5;
  for (const SweepPoint& point : sweep.points)
    page.text({left_mm + kPanel_mm.x() * (0.5 + 0.5 * std::log2(point.factor)), below_mm},
              fmt::format("{:.3g}", point.value), {.height_mm = 2.6, .align = TextAlign::kMiddle});
}

}  // namespace

Drawing design_plot(const std::string& title, const std::vector<Sweep>& sweeps) {
  const Vec2 size_mm(kCorner_mm.x() + 4.0 * kPanelStep_mm.x() + 14.0,
                     kCorner_mm.y() + 4.0 * kPanelStep_mm.y() + 2.0);
  Drawing page(size_mm);
  page.box(Vec2::Zero(), size_mm).fill(drawing::kWhite);
  page.text({7.0, 9.0}, title, {.height_mm = 4.5});
  page.text({7.0, 15.0}, "One number is changed in each column. The large point is the sensor.",
            {.height_mm = 2.8, .color = drawing::kGray});
  for (std::size_t column = 0; column < sweeps.size(); ++column)
    draw_column(page, sweeps[column], kCorner_mm.x() + kPanelStep_mm.x() * column);
  for (std::size_t i = 0; i < kPlotRows.size(); ++i) {
    const Row& row = kPlotRows[i];
    const double top_mm = kCorner_mm.y() + kPanelStep_mm.y() * static_cast<double>(i);
    draw_row_name(page, row, top_mm);
    const Range range = range_of(row, sweeps);
    for (std::size_t column = 0; column < sweeps.size(); ++column) {
      const Panel panel({kCorner_mm.x() + kPanelStep_mm.x() * column, top_mm}, range);
      panel.draw_axes(page, column == 0);
      panel.draw_curve(page, sweeps[column], row.value, kCurve, 1.0);
      if (row.second_value != nullptr)
        panel.draw_curve(page, sweeps[column], row.second_value, kSecondCurve, 0.5);
    }
  }
  return page;
}

}  // namespace flytri::design
