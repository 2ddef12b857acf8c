/// @file  The images of a calibration on a dotted board, which is held by hand.
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "core/calibration/record/calibration_set.h"

namespace flytri::calibration {

struct NamedImage {
  std::string name;  ///< for messages, and of its file
  cv::Mat image;
};

/// The images of the board in one pose, in the order in which they were taken. The dots are taken
/// first and last: so it shows how far the hand moved.
struct BoardPose {
  NamedImage dots;          ///< measurement camera, CV_8UC1 or CV_16UC1, linear in light
  NamedImage vertical;      ///< the same camera, the board lit by one pattern
  NamedImage horizontal;    ///< the same with the other one
  NamedImage dots_texture;  ///< texture camera, CV_8UC3, R, G, B order; empty: there is none
  NamedImage dots_after;    ///< measurement camera
};

/// A board set, see docs/formats.md. The board is white, with the dots of the target in black.
struct BoardSet : CalibrationScene {
  std::vector<BoardPose> poses;

  /// Whether a texture camera took part: then in all poses.
  [[nodiscard]] bool has_texture() const {
    return !poses.empty() && !poses.front().dots_texture.image.empty();
  }
};

/// Sets the file names of the images of pose `index`: b00_d.png and so on.
void name_images(BoardPose& pose, std::size_t index);

}  // namespace flytri::calibration
