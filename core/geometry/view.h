/// @file  A sparse 3D view: points along line profiles, in the sensor frame.
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
  Vec3f deviation_mm;  ///< displacement of the point if the line moved by one standard uncertainty
                       ///< of its localization across its direction: direction and size of the
                       ///< measurement noise, sensor frame
  float along_px = 0;  ///< image row (vertical pattern) or column (horizontal pattern) of the
                       ///< measurement
};

/// A connected run of points on one projected line: neighbors in the vector are neighbors on the
/// surface. A line that is interrupted by a shadow or a depth step gives several profiles.
struct Profile {
  LineIndex line;
  Vec3 sheet_normal;                 ///< s: unit normal of the light sheet, sensor frame
  std::vector<ProfilePoint> points;  ///< by rising along_px, at least 2
};

/// The measured points of one frame (paper: V_i or H_i).
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

/// A copy of the view without its points: only pattern, frame and time.
[[nodiscard]] inline std::shared_ptr<const View> without_points(const View& view) {
  return std::make_shared<const View>(View{view.pattern, view.frame, view.time_s, {}});
}

/// A view with its pose in the world (paper: S_i). The view never changes; the pose may.
struct AlignedView {
  std::shared_ptr<const View> view;
  Isometry T_world_sensor = Isometry::Identity();
};

}  // namespace flytri
