#include "ui/scene/standard_views.h"

#include <cmath>
#include <numbers>

namespace flytri::ui {
namespace {

struct Sight {
  Vec3 towards_eye, up;
};

/// On charts the patient's right is on the left: the front is up for an upper jaw and down for a
/// lower one.
Sight occlusal_sight(const JawAxes& axes, JawKind jaw) {
  const bool front_is_down = jaw == JawKind::kLower && axes.is_arch;
  return {axes.occlusal, front_is_down ? Vec3(-axes.buccal) : axes.buccal};
}

/// From the side `outwards`, with the teeth upwards in a lower jaw and downwards in an upper one.
Sight side_sight(const JawAxes& axes, JawKind jaw, const Vec3& outwards) {
  /// From slightly above the teeth, so that the chewing edge is visible.
  constexpr double kElevation_rad = 20.0 * std::numbers::pi / 180.0;
  return {std::cos(kElevation_rad) * outwards + std::sin(kElevation_rad) * axes.occlusal,
          jaw == JawKind::kUpper ? Vec3(-axes.occlusal) : axes.occlusal};
}

Sight sight_of(const JawAxes& axes, JawKind jaw, StandardView view) {
  const Vec3 right = patient_right(axes, jaw);
  switch (view) {
    case StandardView::kBuccal:
      return side_sight(axes, jaw, axes.buccal);
    case StandardView::kLingual:
      return side_sight(axes, jaw, -axes.buccal);
    case StandardView::kRight:
      return side_sight(axes, jaw, right);
    case StandardView::kLeft:
      return side_sight(axes, jaw, -right);
    case StandardView::kOcclusal:
      break;
  }
  return occlusal_sight(axes, jaw);
}

}  // namespace

Vec3 patient_right(const JawAxes& axes, JawKind jaw) {
  const Vec3 first = axes.buccal.cross(axes.occlusal);
  return jaw == JawKind::kUpper ? Vec3(-first) : first;
}

Eigen::Quaterniond orientation(const JawAxes& axes, JawKind jaw, StandardView view) {
  const Sight sight = sight_of(axes, jaw, view);
  const Vec3 x = sight.up.cross(sight.towards_eye).normalized();
  Eigen::Matrix3d R_world_eye;
  R_world_eye << x, sight.towards_eye.cross(x), sight.towards_eye;
  return Eigen::Quaterniond(R_world_eye);
}

}  // namespace flytri::ui
