/// @file  The background under a line, beside which there may be no dark pixel.
#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "core/localization/background.h"
#include "core/localization/fit_line.h"

namespace flytri::localization {

/// Background under `line` in row `r`, taken from its flanks. Neighbors cover the flanks of dense
/// lines: there it is that of the tile. None if the flanks are outside the image.
/// @param rows  CV_32FC1; lines cross the rows.
[[nodiscard]] std::optional<FlankLevel> level_under_line(const cv::Mat& rows, int r,
                                                         const LineFit& line,
                                                         const Background& background,
                                                         bool is_dense);

}  // namespace flytri::localization
