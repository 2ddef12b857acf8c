/// @file  Measures how far the sensor is from the surface, view by view.
#pragma once

#include <cstddef>

#include "core/geometry/view.h"
#include "core/scan/scan_snapshot.h"

namespace flytri::scan {

class DistanceGauge {
 public:
  /// @param volume_depth_mm  of the measurement volume, > 0
  explicit DistanceGauge(double volume_depth_mm) : volume_depth_mm_(volume_depth_mm) {}
  /// @param view  the next of the scan, with at least one point
  [[nodiscard]] SensorDistance measure(const View& view);

 private:
  double volume_depth_mm_;
  std::size_t most_points_ = 0;  ///< the most of any view so far
};

}  // namespace flytri::scan
