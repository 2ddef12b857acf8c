/// @file  Moves the points that a rolling shutter saw to where they were at the time of the view.
#pragma once

#include <functional>
#include <memory>

#include "core/geometry/view.h"

namespace flytri::trajectory {

/// When a point was seen, by its image row: -0.5 first row, 0 middle row, 0.5 last row. In units of
/// the readout.
/// @param p_mm  the point as measured, sensor frame
using RowShare = std::function<double(const Vec3& p_mm)>;

/// How a camera exposes the rows of its image.
struct Shutter {
  /// Delay of the last row after the first, s. Negative if the last row comes first. 0: global.
  double readout_s = 0.0;
  RowShare row_share = nullptr;  ///< must be set for a rolling shutter

  [[nodiscard]] bool is_rolling() const { return readout_s != 0.0; }
};

/// A point, in the sensor's frame at the time of the view.
/// @param velocity  of the sensor, see sensor_velocities()
/// @param late_s    when it was seen, after the time of the view
/// @param p_mm      the point in the sensor's frame when it was seen
[[nodiscard]] inline Vec3 seen_late(const Twist& velocity, double late_s, const Vec3& p_mm) {
  return exp_twist(late_s * velocity) * p_mm;
}

/// Derivative of seen_late() with respect to `late_s`, mm/s.
/// @param moved_mm  result of seen_late()
[[nodiscard]] inline Vec3 seen_late_derivative(const Twist& velocity, double late_s,
                                               const Vec3& moved_mm) {
  const Vec3 moving = velocity.tail<3>();
  return velocity.head<3>().cross(moved_mm - late_s * moving) + moving;
}

/// The view as a global shutter would have seen it.
/// @param velocity  of the sensor
[[nodiscard]] std::shared_ptr<const View> without_rolling_shutter(const View& view,
                                                                  const Twist& velocity,
                                                                  const Shutter& shutter);

}  // namespace flytri::trajectory
