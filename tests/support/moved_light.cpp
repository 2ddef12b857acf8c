#include "tests/support/moved_light.h"

#include <limits>
#include <memory>

#include "core/refinement/sheet_shift.h"

namespace flytri::testing {

calibration::Calibration camera_calibration() {
  constexpr ImageSize kSize{200, 150};
  constexpr double kMmPerPx = 0.1;
  calibration::Calibration calibration;
  calibration.volume.size_mm = Vec3(20.0, 15.0, 15.0);
  calibration.measurement_size = kSize;
  // x = (u - 100) s (1 + z / distance), and y alike. Terms in the order of kExponents.
  const double per_depth = -1.0 / kCameraCenter_mm.z();
  auto& x = calibration.x_mm.coefficients;
  x[1] = kMmPerPx;
  x[0] = -0.5 * kSize.width_px * x[1];
  x[3] = x[0] * per_depth;
  x[6] = x[1] * per_depth;
  auto& y = calibration.y_mm.coefficients;
  y[2] = kMmPerPx;
  y[0] = -0.5 * kSize.height_px * y[2];
  y[3] = y[0] * per_depth;
  y[8] = y[2] * per_depth;
  return calibration;
}

std::vector<AlignedView> with_tilted_sheets(std::vector<AlignedView> views) {
  for (AlignedView& view : views) {
    View tilted = *view.view;
    for (Profile& profile : tilted.profiles)
      profile.sheet_normal = (profile.sheet_normal + 0.13 * Vec3::UnitZ()).normalized();
    view.view = std::make_shared<View>(std::move(tilted));
  }
  return views;
}

std::vector<AlignedView> misled(std::vector<AlignedView> views,
                                const refinement::ProjectorMotion& moved) {
  for (AlignedView& view : views) {
    if (!moved.concerns(*view.view)) continue;
    View wrong = *view.view;
    for (Profile& profile : wrong.profiles) {
      for (ProfilePoint& point : profile.points) {
        point.position_mm = refinement::seen_with(-moved.motion, point.position_mm,
                                                  profile.sheet_normal, kCameraCenter_mm);
      }
    }
    view.view = std::make_shared<View>(std::move(wrong));
  }
  return views;
}

refinement::ProjectorMotion bump(Pattern pattern, double from_s) {
  refinement::ProjectorMotion moved{pattern, from_s, std::numeric_limits<double>::infinity(),
                                    Twist::Zero()};
  if (pattern == Pattern::kVertical) {
    moved.motion << 0.0, 4e-4, 0.0, 0.02, 0.0, 0.0;
  } else {
    moved.motion << -4e-4, 0.0, 0.0, 0.0, 0.02, 0.0;
  }
  return moved;
}

}  // namespace flytri::testing
