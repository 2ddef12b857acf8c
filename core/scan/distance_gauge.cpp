#include "core/scan/distance_gauge.h"

#include <algorithm>

namespace flytri::scan {

SensorDistance DistanceGauge::measure(const View& view) {
  double sum_mm = 0.0;
  for (const Profile& profile : view.profiles) {
    for (const ProfilePoint& point : profile.points) sum_mm += point.position_mm.z();
  }
  const std::size_t count = view.point_count();
  most_points_ = std::max(most_points_, count);
  return {sum_mm / static_cast<double>(count) / (0.5 * volume_depth_mm_),
          static_cast<double>(count) / static_cast<double>(most_points_)};
}

}  // namespace flytri::scan
