/// @file  Finds and numbers the lines on a dotted board that is tilted as a hand holds it.
#pragma once

#include <string>
#include <vector>

#include "core/base/workers.h"
#include "core/calibration/fit/fit_lateral.h"
#include "core/calibration/fit/number_lines.h"
#include "core/geometry/rigid.h"

namespace flytri::calibration {

/// An image of the board under one pattern.
struct LitBoard {
  cv::Mat image;     ///< CV_8UC1 or CV_16UC1
  std::string name;  ///< for messages
  Isometry T_sensor_board = Isometry::Identity();
};

/// What the search for the lines knows of the sensor.
struct BoardLineScene {
  CalibrationScene scene;
  LateralCalibration lateral;  ///< X and Y
  double distance_mm = 0.0;    ///< from the camera to the middle of the volume
};

/// Localizes the lines of `pattern` in all images, but not near dots, and numbers them in space.
/// A line is one sheet of light from the projector, whose place is searched.
/// @param boards  one for each pose
/// @return  LineOnPlane::plane is the number of the pose
/// @errors  kInsufficient or kInconsistent, naming the image or the pattern.
[[nodiscard]] Result<NumberedLines> number_board_lines(const std::vector<LitBoard>& boards,
                                                       Pattern pattern, const BoardLineScene& scene,
                                                       const localization::LocalizeOptions& options,
                                                       const Workers& workers);

}  // namespace flytri::calibration
