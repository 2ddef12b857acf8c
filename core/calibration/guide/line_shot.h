/// @file  Checks an image of the white plane.
#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <vector>

#include "core/calibration/fit/joined_lines.h"
#include "core/calibration/guide/shot_check_options.h"
#include "core/calibration/guide/shot_verdict.h"
#include "core/imaging/pattern.h"

namespace flytri::calibration {

/// Checks an image of the white plane with all lights off.
[[nodiscard]] ShotVerdict check_dark(const cv::Mat& image, const std::array<int, 2>& line_counts,
                                     const ShotCheckOptions& options);

/// The lines of one image.
struct LineShot {
  ShotVerdict verdict;
  std::vector<JoinedLine> joined_lines;
};

/// Checks an image of the white plane with one pattern. Lines may be missing only if they are
/// outside the image.
/// @param dark         image with all lights off, same size and type
/// @param line_counts  of both patterns
[[nodiscard]] LineShot check_lines(const cv::Mat& image, const cv::Mat& dark, Pattern pattern,
                                   const std::array<int, 2>& line_counts,
                                   const ShotCheckOptions& options);

/// Checks that the plane did not move between two shots of the same lines.
[[nodiscard]] ShotVerdict check_rest(const std::vector<JoinedLine>& before,
                                     const std::vector<JoinedLine>& after,
                                     const ShotCheckOptions& options);

}  // namespace flytri::calibration
