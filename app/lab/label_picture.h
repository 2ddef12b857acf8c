/// @file  A picture of which line each sample of an image belongs to.
#pragma once

#include <opencv2/core.hpp>

#include "core/indexing/index_lines.h"

namespace flytri::lab {

/// The image with each indexed sample in the color of its line. Neighboring lines have colors that
/// are easily told apart; samples without an index stay gray.
/// @param image  CV_8UC1
/// @return  CV_8UC3, R, G, B order
[[nodiscard]] cv::Mat draw_labels(const cv::Mat& image, const indexing::IndexedLines& lines,
                                  Pattern pattern);

}  // namespace flytri::lab
