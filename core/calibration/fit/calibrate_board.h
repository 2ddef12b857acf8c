/// @file  Calibrates a sensor without a stage, from a dotted board that was held by hand.
#pragma once

#include "core/calibration/fit/calibrate.h"
#include "core/calibration/record/board_set.h"

namespace flytri::calibration {

struct BoardOptions {
  CalibrateOptions fit;
  int least_poses = 15;  ///< 8..1000
  /// > 0. How far a point of the volume may move with the board between the first and the last
  /// image of a pose, as a share of the volume's depth. The board is taken to move evenly.
  double max_motion_share = 0.01;
  /// > 0. Largest standard uncertainty of a depth, as a share of that depth: boards that are hardly
  /// tilted do not show how deep the volume is.
  double max_depth_sigma_share = 0.0005;
  /// > 0. Largest mean offset of the lines of a pose from the fit, as a share of the volume's
  /// depth.
  double max_offset_share = 0.002;

  [[nodiscard]] Result<void> validate() const;
};

/// A calibration, and how well it is known.
struct BoardCalibration {
  Calibration calibration;
  double distance_mm = 0.0;        ///< from the camera to the middle of the volume
  double rms_px = 0.0;             ///< of the dots
  double depth_sigma_share = 0.0;  ///< standard uncertainty of a depth, as a share of it
  double largest_motion_mm = 0.0;  ///< of the board during a pose
};

/// The sensor frame: z along the optical axis of the measurement camera, x along u, the origin
/// where the ray of the image's middle is halfway between the nearest and the farthest dots.
/// @source  The poses and the camera: see fit_board_camera. On them the model-free functions of
///          Arold et al., "Calibration".
/// @errors  kInsufficient or kInconsistent; the message names the image or the pose. kCancelled.
[[nodiscard]] Result<BoardCalibration> calibrate_board(const BoardSet& set,
                                                       const BoardOptions& options,
                                                       const Workers& workers,
                                                       const Progress& progress);

}  // namespace flytri::calibration
