#include "ui/scene/eye.h"

#include <algorithm>
#include <cmath>

namespace flytri::ui {
namespace {

/// Distance from the target that encloses the box, rounded up to a step, so that it does not change
/// while the model grows a little.
double reach_mm(const OrbitCamera& camera, const Eigen::AlignedBox3d& box_mm) {
  constexpr double kStep = 1.5;
  const Vec3& target = camera.pose().target_mm;
  double farthest_mm = camera.pose().height_mm;
  if (!box_mm.isEmpty()) {
    const Vec3 offset =
        (target - box_mm.min()).cwiseAbs().cwiseMax((box_mm.max() - target).cwiseAbs());
    farthest_mm = std::max(farthest_mm, offset.norm());
  }
  return std::pow(kStep, std::ceil(std::log(farthest_mm) / std::log(kStep)));
}

}  // namespace

Eigen::Vector2f Eye::focal_px() const {
  return {0.5F * P_clip_eye(0, 0) * static_cast<float>(size.width_px),
          0.5F * P_clip_eye(1, 1) * static_cast<float>(size.height_px)};
}

float Eye::depth_per_mm() const {
  // Normalized depth is -P22 + P23 / w at the distance w.
  return -P_clip_eye(2, 3) / static_cast<float>(distance_mm * distance_mm);
}

void Eye::set_uniforms(const ShaderProgram& program) const {
  program.set("T_eye_world", T_eye_world);
  program.set("P_clip_eye", P_clip_eye);
}

bool Eye::may_see(const Eigen::AlignedBox3f& box_mm) const {
  if (box_mm.isEmpty()) return false;
  const Eigen::Matrix4f& P = P_clip_world;
  for (int axis = 0; axis < 3; ++axis) {
    for (const float side : {-1.0F, 1.0F}) {
      // Inside the plane where row . p >= 0; the box's corner farthest inside decides.
      const Eigen::RowVector4f plane = P.row(3) + side * P.row(axis);
      const Eigen::Vector3f toward = plane.head<3>().transpose();
      const Vec3f corner = (toward.array() > 0.0F).select(box_mm.max(), box_mm.min());
      if (toward.dot(corner) + plane(3) < 0.0F) return false;
    }
  }
  return true;
}

PixelBox whole_picture(const PictureSize& size) {
  return {Eigen::Vector2i(0, 0), Eigen::Vector2i(size.width_px - 1, size.height_px - 1)};
}

PixelBox Eye::pixels_of(const Eigen::AlignedBox3f& box_mm) const {
  if (!may_see(box_mm)) return {};
  const Eigen::Matrix4f& P = P_clip_world;
  PixelBox pixels;
  for (int number = 0; number < 8; ++number) {
    const Vec3f corner = box_mm.corner(static_cast<Eigen::AlignedBox3f::CornerType>(number));
    const Eigen::Vector4f clip = P * corner.homogeneous();
    if (clip.w() <= 0.0F) return whole_picture(size);  // reaches behind the eye
    const Eigen::Array2f share = 0.5F + 0.5F * (clip.head<2>() / clip.w()).array();
    // Limited to twice the picture.
    const Eigen::Array2f px = share.max(-1.0F).min(2.0F) * size_px().array();
    pixels.extend(px.floor().cast<int>().matrix().eval());
  }
  return pixels.intersection(whole_picture(size));
}

Eye make_eye(const OrbitCamera& camera, const PictureSize& size,
             const Eigen::AlignedBox3d& box_mm) {
  /// Smallest distance of the near plane, as a share of the distance to the target.
  constexpr double kNearest = 0.05;
  Eye eye;
  eye.size = size;
  eye.distance_mm = camera.distance_mm();
  eye.height_mm = camera.pose().height_mm;
  const double reach = reach_mm(camera, box_mm);
  const double near_mm = std::max(eye.distance_mm - reach, kNearest * eye.distance_mm);
  eye.T_eye_world = camera.T_world_eye().inverse().matrix().cast<float>();
  eye.P_clip_eye = camera.projection(size.aspect(), near_mm, eye.distance_mm + reach).cast<float>();
  eye.P_clip_world = eye.P_clip_eye * eye.T_eye_world;
  return eye;
}

Vec3 unprojected(const Eye& eye, double x_px, double y_px, double depth) {
  const Eigen::Vector4d clip(2.0 * (x_px + 0.5) / eye.size.width_px - 1.0,
                             1.0 - 2.0 * (y_px + 0.5) / eye.size.height_px, 2.0 * depth - 1.0, 1.0);
  const Eigen::Matrix4d P_clip_world =
      eye.P_clip_eye.cast<double>() * eye.T_eye_world.cast<double>();
  return (P_clip_world.inverse() * clip).hnormalized();
}

}  // namespace flytri::ui
