/// @file  Judges the images of one pose of the dotted board, while the user still holds it.
#pragma once

#include "core/calibration/record/board_set.h"
#include "core/localization/localize.h"

namespace flytri::calibration {

struct BoardShotOptions {
  localization::LocalizeOptions localize;
  double min_cover = 0.7;    ///< 0..1. The dots cover this share of the image's width and height.
  double max_motion = 0.05;  ///< > 0, of the dots' distance, from the first to the last image
  double min_lines = 0.3;    ///< 0..1. Of the lines' length, if all lay on the board
  double max_saturated = 0.002;  ///< 0..1, of the pixels

  [[nodiscard]] Result<void> validate() const;
};

/// @errors  kInconsistent or kInsufficient: what is wrong with which image, and what to do.
[[nodiscard]] Result<void> check_board_pose(const BoardPose& pose, const CalibrationScene& scene,
                                            const BoardShotOptions& options);

}  // namespace flytri::calibration
