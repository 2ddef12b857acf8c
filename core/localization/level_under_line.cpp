#include "core/localization/level_under_line.h"

#include <span>

namespace flytri::localization {

std::optional<FlankLevel> level_under_line(const cv::Mat& rows, int r, const LineFit& line,
                                           const Background& background, bool is_dense) {
  if (is_dense) return FlankLevel{background.level(r, static_cast<int>(line.center_px)), 0.0F};
  return flank_level(std::span(rows.ptr<float>(r), static_cast<std::size_t>(rows.cols)), line);
}

}  // namespace flytri::localization
