/// @file  The image of a projected line, computed from the lenses of a sensor: its width, its
/// motion with depth, and how exactly it can be located.
#pragma once

#include <vector>

#include "hw/simulated/optics/lens_blur.h"
#include "hw/simulated/optics/line_profile.h"
#include "hw/simulated/optics/sensor_model.h"

namespace flytri::design {

/// The middle line in the middle of the image, on a white plane that faces the sensor.
struct LineFigures {
  double z_mm = 0.0;
  double pixel_mm = 0.0;          ///< size of a pixel on the object, across the line
  double width_mm = 0.0;          ///< on the object, full width at half maximum
  double width_px = 0.0;          ///< in the image, as the localization measures it
  double camera_blur_px = 0.0;    ///< of a point, full width at half maximum
  double motion_px_per_mm = 0.0;  ///< of the line across, by depth
  double deviation_px = 0.0;      ///< standard uncertainty of the line's position
  double deviation_mm = 0.0;      ///< and of the depth that follows from it
};

/// Immutable.
class LineImager {
 public:
  /// @param sensor  valid
  LineImager(const simulated::SensorModel& sensor, Pattern pattern);

  [[nodiscard]] LineFigures figures(double z_mm) const;
  /// Only the width in the image, which is quicker.
  [[nodiscard]] double width_px(double z_mm) const;

 private:
  class Section;
  [[nodiscard]] Section section(double z_mm) const;

  simulated::SensorModel sensor_;
  Pattern pattern_;
  double nearest_mm_, farthest_mm_;  ///< from the camera: depths that can be computed
  simulated::LineProfile profile_;
  simulated::LensBlur blur_;
  double gain_ = 1.0;  ///< makes the line as bright as ChipModel::line_level in the middle
};

/// The depths at which LineImager works: this far before and behind the middle of the volume.
[[nodiscard]] double imager_reach_mm(const simulated::SensorModel& sensor);

}  // namespace flytri::design
