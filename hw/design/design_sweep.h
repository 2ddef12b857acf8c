/// @file  What changing one number of a sensor does to it.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "hw/design/design_figures.h"

namespace flytri::design {

/// The numbers that can be changed.
enum class Knob { kBaseline, kFocalLength, kLines, kField };
inline constexpr std::array kKnobs = {Knob::kBaseline, Knob::kFocalLength, Knob::kLines,
                                      Knob::kField};

/// The name shown to the user, and the unit of its values.
[[nodiscard]] std::string_view to_string(Knob knob);
[[nodiscard]] std::string_view unit_of(Knob knob);

/// One changed sensor. Of the lines and the field, the value is that of the vertical lines and of
/// the width.
struct SweepPoint {
  double factor = 1.0;  ///< times the number of the layout
  double value = 0.0;
  DesignFigures figures;
};

struct Sweep {
  Knob knob = Knob::kBaseline;
  std::vector<SweepPoint> points;  ///< by rising value; one of them is the layout itself
};

/// All numbers changed one by one, all others as in the layout.
/// @param pixel_um  pitch of the pixels of the measurement camera
/// @errors  As design_figures.
[[nodiscard]] Result<std::vector<Sweep>> design_sweeps(const simulated::SensorLayout& layout,
                                                       double pixel_um);

}  // namespace flytri::design
