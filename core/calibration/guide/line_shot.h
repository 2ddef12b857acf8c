/// @file  Checks an image of the white plane at once: from the image to its lines and a verdict.
#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <vector>

#include "core/calibration/fit/joined_lines.h"
#include "core/calibration/guide/shot_check_options.h"
#include "core/calibration/guide/shot_verdict.h"
#include "core/imaging/pattern.h"

namespace flytri::calibration {

/// The white plane without any light of the sensor's.
[[nodiscard]] ShotVerdict check_dark(const cv::Mat& image, const std::array<int, 2>& line_counts,
                                     const ShotCheckOptions& options);

/// The lines of one image; those that may be numbered by their order if the verdict is good.
struct LineShot {
  ShotVerdict verdict;
  std::vector<JoinedLine> joined_lines;
};

/// The white plane under one pattern. Lines may be missing only where they have left the image.
/// @param dark         the plane without light, of the same size and type
/// @param line_counts  of both patterns
[[nodiscard]] LineShot check_lines(const cv::Mat& image, const cv::Mat& dark, Pattern pattern,
                                   const std::array<int, 2>& line_counts,
                                   const ShotCheckOptions& options);

/// Whether the plane rested between two shots of the same lines.
[[nodiscard]] ShotVerdict check_rest(const std::vector<JoinedLine>& before,
                                     const std::vector<JoinedLine>& after,
                                     const ShotCheckOptions& options);

}  // namespace flytri::calibration
