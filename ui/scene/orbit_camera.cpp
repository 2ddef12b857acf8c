#include "ui/scene/orbit_camera.h"

#include <algorithm>
#include <cmath>

#include "core/base/check_options.h"

namespace flytri::ui {
namespace {

/// Room between the box and the border of the picture, as a share of the distance.
constexpr double kFitMargin = 0.06;

/// 0 to 1 with speed and acceleration 0 at both ends: "smootherstep".
/// @source  Perlin, "Improving Noise", SIGGRAPH 2002.
double eased(double share) { return share * share * share * (share * (share * 6.0 - 15.0) + 10.0); }

CameraPose between(const CameraPose& from, const CameraPose& to, double share) {
  CameraPose pose;
  pose.target_mm = from.target_mm + share * (to.target_mm - from.target_mm);
  pose.q_world_eye = from.q_world_eye.slerp(share, to.q_world_eye);
  // Sizes are felt as ratios.
  pose.height_mm = from.height_mm * std::pow(to.height_mm / from.height_mm, share);
  return pose;
}

}  // namespace

Result<void> CameraOptions::validate() const {
  return OptionCheck("CameraOptions")
      .in_range("field_of_view_rad", field_of_view_rad, 0.01, 2.0)
      .positive("orbit_rad_per_height", orbit_rad_per_height)
      .positive("min_height_mm", min_height_mm)
      .must("max_height_mm", max_height_mm, max_height_mm > min_height_mm, "above min_height_mm")
      .result();
}

OrbitCamera::OrbitCamera(const CameraOptions& options) : options_(options) {}

void OrbitCamera::set_pose(const CameraPose& pose) {
  pose_ = pose;
  pose_.q_world_eye.normalize();
  remaining_s_ = 0.0;
}

void OrbitCamera::orbit(double dx_px, double dy_px, const PictureSize& size) {
  orbit(dx_px, dy_px, size, pose_.target_mm);
}

void OrbitCamera::orbit(double dx_px, double dy_px, const PictureSize& size, const Vec3& pivot_mm) {
  const double rad_per_px = options_.orbit_rad_per_height / size.height_px;
  CameraPose turned = pose_;
  turned.q_world_eye = pose_.q_world_eye * Eigen::AngleAxisd(-dx_px * rad_per_px, Vec3::UnitY()) *
                       Eigen::AngleAxisd(-dy_px * rad_per_px, Vec3::UnitX());
  const Eigen::Quaterniond turn = turned.q_world_eye * pose_.q_world_eye.conjugate();
  turned.target_mm = pivot_mm + turn * (pose_.target_mm - pivot_mm);
  set_pose(turned);
}

void OrbitCamera::roll(double angle_rad) {
  CameraPose turned = pose_;
  turned.q_world_eye = pose_.q_world_eye * Eigen::AngleAxisd(-angle_rad, Vec3::UnitZ());
  set_pose(turned);
}

void OrbitCamera::pan(double dx_px, double dy_px, const PictureSize& size) {
  const double mm_per_px = pose_.height_mm / size.height_px;
  CameraPose moved = pose_;
  moved.target_mm += pose_.q_world_eye * Vec3(-dx_px * mm_per_px, dy_px * mm_per_px, 0.0);
  set_pose(moved);
}

void OrbitCamera::zoom(double factor) {
  CameraPose zoomed = pose_;
  zoomed.height_mm =
      std::clamp(pose_.height_mm / factor, options_.min_height_mm, options_.max_height_mm);
  set_pose(zoomed);
}

void OrbitCamera::zoom_at(double factor, double x_px, double y_px, const PictureSize& size) {
  const double before_mm = pose_.height_mm;
  zoom(factor);
  const double grown = (before_mm - pose_.height_mm) / pose_.height_mm;
  pan(-grown * (x_px - 0.5 * size.width_px), -grown * (y_px - 0.5 * size.height_px), size);
}

void OrbitCamera::fly_to(const CameraPose& pose, double duration_s) {
  from_ = pose_;
  to_ = pose;
  to_.q_world_eye.normalize();
  duration_s_ = remaining_s_ = duration_s;
  if (!(duration_s > 0.0)) set_pose(to_);
}

bool OrbitCamera::advance(double dt_s) {
  if (!is_flying()) return false;
  remaining_s_ -= dt_s;
  if (remaining_s_ > 0.0) {
    pose_ = between(from_, to_, eased(1.0 - remaining_s_ / duration_s_));
  } else {
    set_pose(to_);
  }
  return true;
}

CameraPose OrbitCamera::fitting(std::span<const Vec3> points_mm,
                                const Eigen::Quaterniond& q_world_eye,
                                const PictureSize& size) const {
  CameraPose pose = pose_;
  pose.q_world_eye = q_world_eye.normalized();
  if (points_mm.empty()) return pose;
  const Eigen::Quaterniond q_eye_world = pose.q_world_eye.conjugate();
  Eigen::AlignedBox3d seen_mm;
  for (const Vec3& p_world : points_mm) seen_mm.extend(q_eye_world * p_world);
  pose.target_mm = pose.q_world_eye * seen_mm.center();
  const double slope = std::tan(0.5 * options_.field_of_view_rad);
  double distance_mm = 0.0;
  for (const Vec3& p_world : points_mm) {
    const Vec3 p_eye = q_eye_world * (p_world - pose.target_mm);
    const double side_mm = std::max(std::abs(p_eye.y()), std::abs(p_eye.x()) / size.aspect());
    distance_mm = std::max(distance_mm, side_mm * (1.0 + kFitMargin) / slope + p_eye.z());
  }
  pose.height_mm =
      std::clamp(2.0 * distance_mm * slope, options_.min_height_mm, options_.max_height_mm);
  return pose;
}

double OrbitCamera::distance_mm() const {
  return 0.5 * pose_.height_mm / std::tan(0.5 * options_.field_of_view_rad);
}

Isometry OrbitCamera::T_world_eye() const {
  return make_isometry(pose_.q_world_eye,
                       pose_.target_mm + pose_.q_world_eye * Vec3(0.0, 0.0, distance_mm()));
}

Eigen::Matrix4d OrbitCamera::projection(double aspect, double near_mm, double far_mm) const {
  const double scale = 1.0 / std::tan(0.5 * options_.field_of_view_rad);
  Eigen::Matrix4d P_clip_eye = Eigen::Matrix4d::Zero();
  P_clip_eye(0, 0) = scale / aspect;
  P_clip_eye(1, 1) = scale;
  P_clip_eye(2, 2) = -(far_mm + near_mm) / (far_mm - near_mm);
  P_clip_eye(2, 3) = -2.0 * far_mm * near_mm / (far_mm - near_mm);
  P_clip_eye(3, 2) = -1.0;
  return P_clip_eye;
}

Eigen::ParametrizedLine<double, 3> OrbitCamera::ray(double x_px, double y_px,
                                                    const PictureSize& size) const {
  const Isometry T = T_world_eye();
  const double slope = std::tan(0.5 * options_.field_of_view_rad);
  const Vec3 direction_eye(slope * size.aspect() * (2.0 * (x_px + 0.5) / size.width_px - 1.0),
                           slope * (1.0 - 2.0 * (y_px + 0.5) / size.height_px), -1.0);
  return {T.translation(), (T.linear() * direction_eye).normalized()};
}

CameraPose pose_through_sensor(const Isometry& T_world_sensor, const Vec3& volume_mm) {
  // The sensor looks along +z with y down, the eye along -z with y up.
  const Eigen::Quaterniond q_sensor_eye(Eigen::AngleAxisd(M_PI, Vec3::UnitX()));
  CameraPose pose;
  pose.target_mm = T_world_sensor.translation();
  pose.q_world_eye = Eigen::Quaterniond(T_world_sensor.linear()) * q_sensor_eye;
  pose.height_mm = 1.6 * volume_mm.head<2>().maxCoeff();
  return pose;
}

CameraPose pose_facing(const Vec3& point_mm, const Vec3& normal, const Vec3& up, double height_mm) {
  const Vec3 z = normal.normalized();
  Vec3 x = up.cross(z);
  if (x.norm() < 1e-6 * up.norm()) x = z.unitOrthogonal();
  x.normalize();
  Eigen::Matrix3d R_world_eye;
  R_world_eye << x, z.cross(x), z;
  return {point_mm, Eigen::Quaterniond(R_world_eye), height_mm};
}

}  // namespace flytri::ui
