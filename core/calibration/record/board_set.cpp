#include "core/calibration/record/board_set.h"

#include <fmt/format.h>

namespace flytri::calibration {

void name_images(BoardPose& pose, std::size_t index) {
  pose.dots.name = fmt::format("b{:02}_d.png", index);
  pose.vertical.name = fmt::format("b{:02}_v.png", index);
  pose.horizontal.name = fmt::format("b{:02}_h.png", index);
  pose.dots_texture.name = fmt::format("b{:02}_t.png", index);
  pose.dots_after.name = fmt::format("b{:02}_e.png", index);
}

}  // namespace flytri::calibration
