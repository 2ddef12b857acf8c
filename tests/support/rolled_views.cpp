#include "tests/support/rolled_views.h"

#include <memory>
#include <utility>

#include "core/reconstruct/row_share.h"
#include "tests/support/moved_light.h"

namespace flytri::testing {

trajectory::RowShare camera_rows() {
  static const calibration::Calibration kCalibration = camera_calibration();
  return reconstruct::row_share_of(kCalibration);
}

std::vector<AlignedView> rolled(std::vector<AlignedView> views, double readout_s) {
  const trajectory::RowShare row_share = camera_rows();
  std::vector<Isometry> poses;
  for (const AlignedView& view : views) poses.push_back(view.T_world_sensor);
  const std::vector<Twist> velocities = refinement::velocities_of(views, poses);
  for (std::size_t v = 0; v < views.size(); ++v) {
    View seen = *views[v].view;
    for (Profile& profile : seen.profiles) {
      for (ProfilePoint& point : profile.points) {
        const Vec3 at_once_mm = point.position_mm;
        // The row is that in which the point is seen in the end.
        for (int i = 0; i < 4; ++i) {
          const double late_s = readout_s * row_share(point.position_mm);
          point.position_mm = exp_twist(late_s * velocities[v]).inverse() * at_once_mm;
        }
      }
    }
    views[v].view = std::make_shared<View>(std::move(seen));
  }
  return views;
}

}  // namespace flytri::testing
