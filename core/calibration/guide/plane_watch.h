/// @file  Checks that each plane of a guided calibration is at its stated depth, by comparison with
///          earlier planes.
#pragma once

#include <map>
#include <vector>

#include "core/calibration/guide/depth_track.h"
#include "core/calibration/guide/dot_shot.h"
#include "core/calibration/guide/line_shot.h"

namespace flytri::calibration {

/// There is no calibration yet, but lines and dots move and blur smoothly with the depth. The first
/// plane is accepted; the second must differ from it; from the third plane on, the depth is checked
/// to about a twentieth of a step.
class PlaneWatch {
 public:
  /// Stores the measurements of a shot, or rejects it if it does not fit the other planes.
  /// @param shot  with a good verdict
  [[nodiscard]] ShotVerdict check_lines(const LineShot& shot, Pattern pattern, double z_mm);
  /// @param is_texture  image of the texture camera
  [[nodiscard]] ShotVerdict check_dots(const DotShot& shot, const DotTarget& target,
                                       bool is_texture, double z_mm);

  /// Drops the measurements of a plane that is taken again.
  void forget_lines(double z_mm);
  void forget_dots(double z_mm);

 private:
  /// The lines of one pattern.
  struct Lines {
    std::map<double, std::vector<double>> middles_px;  // by depth
    DepthTrack position_px;                            // of one fixed place of the pattern
    DepthTrack width_px;
  };
  /// The dots of one camera.
  struct Dots {
    DepthTrack mesh_px;  // 1 / pitch: proportional to the distance from the camera
    DepthTrack origin_u_px, origin_v_px;
    DepthTrack edge_px;
  };
  std::array<Lines, 2> lines_;  // by Pattern
  std::array<Dots, 2> dots_;    // measurement camera, texture camera
};

}  // namespace flytri::calibration
