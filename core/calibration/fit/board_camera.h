/// @file  Finds the lens of the measurement camera and all poses of the board together.
#pragma once

#include <string>
#include <vector>

#include "core/calibration/fit/number_dots.h"
#include "core/geometry/rigid.h"
#include "core/imaging/frame.h"

namespace flytri::calibration {

/// The dots of one image.
struct BoardView {
  std::string name;  ///< of the image, for messages
  std::vector<NumberedDot> dots;
};

/// The frame of the camera: origin in its pupil, z along the optical axis, x along u, y along v.
struct BoardCamera {
  std::vector<Isometry> T_camera_board;  ///< by view; the board's frame: dot (0, 0), x along i
  /// The dots that fit. Unlike those given, they are where the camera sees the dot's middle.
  std::vector<BoardView> views;
  double focal_px = 0.0;
  double focal_sigma_px = 0.0;      ///< standard uncertainty
  double rms_px = 0.0;              ///< of both coordinates of a dot together
  Vec3 middle_ray = Vec3::UnitZ();  ///< of the image, with z = 1
};

/// Finds dark dots on white and numbers them.
/// @param image  as BoardPose
/// @errors  As number_dots, naming the image.
[[nodiscard]] Result<BoardView> find_board_dots(const cv::Mat& image, const std::string& name,
                                                const DotTarget& target);

/// Bundle adjustment of a pinhole camera with radial and tangential distortion, and all poses.
/// @source  Zhang, "A flexible new technique for camera calibration", 2000; OpenCV's
///          calibrateCamera. The image of a tilted disk is an ellipse, whose middle is not the
///          image of the disk's middle: Heikkila, "Geometric camera calibration using circular
///          control points", 2000.
/// @errors  kInsufficient or kInconsistent, naming the image where it is one.
[[nodiscard]] Result<BoardCamera> fit_board_camera(const std::vector<BoardView>& views,
                                                   const DotTarget& target, ImageSize image_size);

}  // namespace flytri::calibration
