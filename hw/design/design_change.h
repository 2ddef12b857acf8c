/// @file  Another sensor: a layout of which some numbers are changed.
#pragma once

#include <array>
#include <optional>

#include "core/base/result.h"
#include "hw/simulated/optics/sensor_layout.h"

namespace flytri::design {

/// What is not set stays as in the layout, or follows from what is set.
struct DesignChange {
  double pixel_um = 3.45;  ///< > 0, pitch of the camera's pixels; joins focal lengths to pixels
  /// Width and height of the volume. The focal lengths of both cameras, the width of the lines and
  /// the dots follow, so that all keep their sizes in pixels.
  std::optional<Vec2> field_mm;
  std::optional<double> depth_mm;     ///< of the volume
  std::optional<double> distance_mm;  ///< to the middle of the volume; the focus follows
  std::optional<double> baseline_mm;
  std::optional<double> focus_mm;               ///< distance of the plane in focus
  std::optional<double> focal_mm;               ///< focal length of the measurement camera's lens
  std::optional<double> camera_aperture_mm;     ///< diameter
  std::optional<double> projector_aperture_mm;  ///< diameter
  std::optional<double> line_width_mm;          ///< on the object, in focus
  std::optional<std::array<int, 2>> lines;      ///< vertical, horizontal

  [[nodiscard]] Result<void> validate() const;
};

/// @errors  kBadOption: a number is out of its range, or they do not fit each other.
[[nodiscard]] Result<simulated::SensorLayout> changed(const simulated::SensorLayout& layout,
                                                      const DesignChange& change);

/// Angle between the axes of the camera and a projector, rad.
[[nodiscard]] double triangulation_angle_rad(const simulated::SensorLayout& layout);

/// Focal length of the lens of the measurement camera.
[[nodiscard]] double camera_focal_mm(const simulated::SensorLayout& layout, double pixel_um);

}  // namespace flytri::design
