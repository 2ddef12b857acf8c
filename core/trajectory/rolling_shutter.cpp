#include "core/trajectory/rolling_shutter.h"

namespace flytri::trajectory {

std::shared_ptr<const View> without_rolling_shutter(const View& view, const Twist& velocity,
                                                    const Shutter& shutter) {
  auto moved = std::make_shared<View>(view);
  for (Profile& profile : moved->profiles) {
    for (ProfilePoint& point : profile.points) {
      const double late_s = shutter.readout_s * shutter.row_share(point.position_mm);
      point.position_mm = seen_late(velocity, late_s, point.position_mm);
    }
  }
  return moved;
}

}  // namespace flytri::trajectory
