/// @file  Whether each line of a sensor is seen in an area of the image of its own.
#pragma once

#include "hw/simulated/optics/sensor_layout.h"

namespace flytri::design {

/// Areas that are nearer than this are taken for touching: noise would swap the labels of lines.
inline constexpr double kLeastGap_px = 2.0;

/// @source  Arold et al., "Line Indexing". The worst of all lines and rows counts.
struct UniqueAreas {
  double spacing_px = 0.0;  ///< least distance of neighboring lines on a plane, in the middle depth
  double motion_px = 0.0;   ///< largest motion of a line through the depth of the volume
  double gap_px = 0.0;      ///< least distance of neighboring areas; below 0: they overlap
};

/// @param depth_mm  of the volume
[[nodiscard]] UniqueAreas unique_areas(const simulated::SensorModel& sensor, Pattern pattern,
                                       double depth_mm);

/// The largest depth of the volume at which the areas are kLeastGap_px apart.
[[nodiscard]] double largest_depth_mm(const simulated::SensorModel& sensor, Pattern pattern);

/// The largest number of lines with which the areas are kLeastGap_px apart. 1 if no number is.
[[nodiscard]] int most_lines(const simulated::SensorLayout& layout, Pattern pattern);

}  // namespace flytri::design
