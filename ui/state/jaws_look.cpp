#include "ui/state/jaws_look.h"

#include <algorithm>
#include <numbers>

#include "ui/state/review_look.h"

namespace flytri::ui {
namespace {

constexpr double kWidest_rad = 30.0 * std::numbers::pi / 180.0;
constexpr double kFarthest_mm = 30.0;
/// Of the joints: behind the last molars, and above the chewing surfaces.
constexpr double kJointBehind_mm = 40.0, kJointAbove_mm = 40.0;

}  // namespace

bool can_meet(const ByStage<bool>& are_finished) {
  const bool has_bite = std::any_of(io::kBites.begin(), io::kBites.end(), [&](io::ScanStage bite) {
    return are_finished[index_of(bite)];
  });
  return has_bite && are_finished[index_of(io::ScanStage::kUpper)] &&
         are_finished[index_of(io::ScanStage::kLower)];
}

bool shows_finished_bite(const AppView& view) {
  return io::is_bite(view.stage) && view.scan != nullptr &&
         view.scan->phase == scan::ScanPhase::kFinished;
}

const JawPair* shown_jaws(const AppView& view, const WindowState& state) {
  return shows_finished_bite(view) && state.jaws.are_shown ? view.occlusion.pair.get() : nullptr;
}

ColorMode shown_colors(const AppView& view, const WindowState& state) {
  if (shown_undercut(view, state) != nullptr) return ColorMode::kUndercut;
  if (shown_jaws(view, state) == nullptr) return state.color_mode;
  if (state.jaws.shows_clearance) return ColorMode::kClearance;
  return state.color_mode == ColorMode::kTexture ? ColorMode::kTexture : ColorMode::kShading;
}

Isometry opening(const JawAxes& upper_axes, double share) {
  if (!upper_axes.is_arch)
    return Isometry(Eigen::Translation3d(share * kFarthest_mm * upper_axes.occlusal));
  const Eigen::Matrix3d R_jaw_world = upper_axes.R_jaw_world();
  const Vec3 back_jaw_mm = upper_axes.box_mm.min();
  const Vec3 joint_jaw_mm(upper_axes.box_mm.center().x(), back_jaw_mm.y() - kJointBehind_mm,
                          upper_axes.box_mm.center().z() - kJointAbove_mm);
  const Vec3 joint_mm = R_jaw_world.transpose() * joint_jaw_mm;
  const Vec3 axis = R_jaw_world.row(0).transpose();
  return Isometry(Eigen::Translation3d(joint_mm) * Eigen::AngleAxisd(share * kWidest_rad, axis) *
                  Eigen::Translation3d(-joint_mm));
}

}  // namespace flytri::ui
