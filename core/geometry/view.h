/// @file  A sparse 3D view: exact points along few line profiles, in the sensor frame.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "core/base/index.h"
#include "core/geometry/rigid.h"
#include "core/imaging/pattern.h"

namespace flytri {

/// One measured point of a line profile.
struct ProfilePoint {
  Vec3 position_mm;    ///< sensor frame
  Vec3f deviation_mm;  ///< where the point would go, relative to where it is, if the line lay one
                       ///< standard uncertainty of its localization farther along its row or
                       ///< column: direction and size of the measurement noise, sensor frame
  float along_px = 0;  ///< image row (vertical pattern) or column (horizontal) it was measured in
};

/// A connected run of points on one projected line: neighbors in the vector are neighbors on the
/// surface. A line that is interrupted by a shadow or a depth step gives several profiles.
struct Profile {
  LineIndex line;
  Vec3 sheet_normal;                 ///< s: unit normal of the light sheet, sensor frame
  std::vector<ProfilePoint> points;  ///< by rising along_px, at least 2
};

/// What one measurement frame became (paper: V_i or H_i).
struct View {
  Pattern pattern = Pattern::kVertical;
  FrameIndex frame;
  double time_s = 0.0;
  std::vector<Profile> profiles;

  [[nodiscard]] std::size_t point_count() const {
    std::size_t count = 0;
    for (const Profile& profile : profiles) count += profile.points.size();
    return count;
  }
};

/// What is left of a view when its points are let go: when it was taken, and how.
[[nodiscard]] inline std::shared_ptr<const View> without_points(const View& view) {
  return std::make_shared<const View>(View{view.pattern, view.frame, view.time_s, {}});
}

/// A view with its place in the world (paper: S_i). The view itself never changes, its pose does.
struct AlignedView {
  std::shared_ptr<const View> view;
  Isometry T_world_sensor = Isometry::Identity();
};

}  // namespace flytri
