#include "core/calibration/record/calibration_set.h"

#include <fmt/format.h>

namespace flytri::calibration {

void name_images(CalibrationPlane& plane, std::size_t index) {
  plane.vertical_name = fmt::format("z{:02}_v.png", index);
  plane.horizontal_name = fmt::format("z{:02}_h.png", index);
  plane.dots_name = fmt::format("z{:02}_d.png", index);
  plane.dots_texture_name = fmt::format("z{:02}_t.png", index);
}

}  // namespace flytri::calibration
