/// @file  A chart of curves over one axis.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hw/drawing/drawing.h"

namespace flytri::lab {

struct Curve {
  std::string name;          ///< in the legend; empty: not there
  std::vector<Vec2> points;  ///< by rising x
  std::vector<Vec2> band;    ///< parallel to points: lower and upper limit; empty: none
  drawing::Color color;
  bool is_thin = false;  ///< one of many that only show how they scatter
};

struct Chart {
  std::string title, note;     ///< the note is a line of smaller text below
  std::string x_name, y_name;  ///< with their units
  std::vector<Curve> curves;   ///< the last ones are drawn on top
};

/// The chart on a page of its own. The y axis has zero in it.
/// @param chart  at least one point with another x than the others
[[nodiscard]] drawing::Drawing draw_chart(const Chart& chart);

}  // namespace flytri::lab
