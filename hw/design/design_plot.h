/// @file  Plot of the sweeps: how baseline, focal length, lines and field change a sensor.
#pragma once

#include <string>
#include <vector>

#include "hw/design/design_sweep.h"
#include "hw/drawing/drawing.h"

namespace flytri::design {

/// A column for each number that is changed, a row for each result. The layout itself is marked.
[[nodiscard]] drawing::Drawing design_plot(const std::string& title,
                                           const std::vector<Sweep>& sweeps);

}  // namespace flytri::design
