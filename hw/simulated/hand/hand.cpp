#include "hw/simulated/hand/hand.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/check_options.h"

namespace flytri::simulated {
namespace {

constexpr double kStep_s = 1.0 / 120.0;
constexpr std::size_t kRecentPoses = 30;
// Time that the hand needs to stop at an end of the path, and again to reach full speed.
constexpr double kTurnAround_s = 0.4;
// Lift height in volume depths, along the viewing direction; nothing is in the volume then.
constexpr double kAwayDepths = 3.0;
// Time constant with which the distance to the surface is adjusted.
constexpr double kDepthSmoothing_s = 0.25;
// Time that the hand holds still after it has put the sensor back on the path.
constexpr double kHold_s = 0.5;
// Shortest duration of a mode change.
constexpr double kMinFade_s = 0.2;

double smooth_step(double t) {
  const double s = std::clamp(t, 0.0, 1.0);
  return s * s * (3.0 - 2.0 * s);
}

Vec3 limited(const Vec3& v, double length) {
  const double norm = v.norm();
  return norm > length ? Vec3(v * (length / norm)) : v;
}

Vec3 rotation_vector(const Eigen::Matrix3d& R) {
  Isometry T = Isometry::Identity();
  T.linear() = R;
  return log_twist(T).head<3>();
}

Eigen::Matrix3d rotation_of(const Vec3& vector_rad) {
  Twist twist = Twist::Zero();
  twist.head<3>() = vector_rad;
  return exp_twist(twist).linear();
}

}  // namespace

Result<void> HandOptions::validate() const {
  return OptionCheck("HandOptions")
      .positive("speed_widths_s", speed_widths_s)
      .positive("turn_rad_s", turn_rad_s)
      .positive("air_factor", air_factor)
      .in_range("eagerness_hz", eagerness_hz, 1.0, 20.0)
      .result();
}

Hand::Hand(RayScene scene, SensorModel sensor, SensorPath path, const HandOptions& options)
    : scene_(std::move(scene)),
      sensor_(std::move(sensor)),
      path_(std::move(path)),
      options_(options),
      speed_mm_s_(options.speed_widths_s * sensor_.volume.size_mm.x()) {
  recent_.push_back({0.0, goal()});
}

void Hand::follow_path() {
  if (mode_ != device::HandMode::kPath) change_mode(device::HandMode::kPath);
}

void Hand::follow_pointer(const device::HandAim& aim) {
  pointed_ = aim;
  const Vec3 towards = aim.towards_sensor.normalized();
  pointed_.towards_sensor = towards;
  const Vec3 wanted =
      aim.along.isZero() ? recent_.back().T_model_sensor.linear().col(0) : aim.along;
  const Vec3 across = wanted - wanted.dot(towards) * towards;
  pointed_.along = across.norm() > 1e-3 ? across : towards.unitOrthogonal();
  if (mode_ != device::HandMode::kPointer) change_mode(device::HandMode::kPointer);
}

void Hand::take_away() {
  if (mode_ != device::HandMode::kAway) change_mode(device::HandMode::kAway);
}

void Hand::change_mode(device::HandMode mode) {
  const Isometry T_model_hand = recent_.back().T_model_sensor;
  const bool in_air = mode == device::HandMode::kAway || mode_ == device::HandMode::kAway;
  mode_ = mode;
  if (mode == device::HandMode::kPointer) {
    // From the air, the hand lands at the pointer; otherwise it starts from its current place.
    T_model_follower_ = in_air ? aimed_pose(pointed_) : T_model_hand;
    velocity_mm_s_.setZero();
    turning_rad_s_.setZero();
    depth_mm_ = in_air ? surface_depth(scene_, sensor_, T_model_follower_).value_or(0.0) : 0.0;
  } else if (mode == device::HandMode::kAway) {
    const double back_mm = kAwayDepths * sensor_.volume.size_mm.z();
    T_model_away_ = T_model_hand * Eigen::Translation3d(-back_mm * Vec3::UnitZ());
  } else {
    path_pace_ = 0.0;
  }
  T_goal_hand_ = goal().inverse() * T_model_hand;
  const double factor = in_air ? options_.air_factor : 1.0;
  // The maximal speed of the smooth step is 1.5 times its mean speed.
  fade_s_ =
      std::max({1.5 * T_goal_hand_.translation().norm() / (factor * speed_mm_s_),
                1.5 * rotation_angle(T_goal_hand_) / (factor * options_.turn_rad_s), kMinFade_s});
  faded_s_ = 0.0;
  hold_s_ = mode == device::HandMode::kPath && in_air ? fade_s_ + kHold_s : 0.0;
}

Isometry Hand::goal() const {
  switch (mode_) {
    case device::HandMode::kPath:
      return path_.T_model_sensor(path_.start_s() + path_s_);
    case device::HandMode::kPointer:
      return T_model_follower_ * Eigen::Translation3d(depth_mm_ * Vec3::UnitZ());
    case device::HandMode::kAway:
      break;
  }
  return T_model_away_;
}

void Hand::advance(double time_s) {
  while (recent_.back().time_s < time_s) step();
}

void Hand::step() {
  if (mode_ == device::HandMode::kPath) step_path();
  if (mode_ == device::HandMode::kPointer) step_pointer();
  faded_s_ += kStep_s;
  const double faded = fade_s_ > 0.0 ? smooth_step(faded_s_ / fade_s_) : 1.0;
  const Isometry T_model_hand =
      faded < 1.0 ? goal() * interpolate(T_goal_hand_, Isometry::Identity(), faded) : goal();
  recent_.push_back({recent_.back().time_s + kStep_s, T_model_hand});
  if (recent_.size() > kRecentPoses) recent_.pop_front();
}

// Brakes before the end of the path, then reverses.
void Hand::step_path() {
  if (hold_s_ > 0.0) {
    hold_s_ -= kStep_s;
    return;
  }
  const double length_s = path_.end_s() - path_.start_s();
  const double remaining_s = forwards_ ? length_s - path_s_ : path_s_;
  const double braking_s = 0.5 * path_pace_ * path_pace_ * kTurnAround_s;
  if (remaining_s <= braking_s) forwards_ = !forwards_;
  const double change = kStep_s / kTurnAround_s;
  const double wanted = forwards_ ? 1.0 : -1.0;
  path_pace_ += std::clamp(wanted - path_pace_, -change, change);
  path_s_ = std::clamp(path_s_ + path_pace_ * kStep_s, 0.0, length_s);
}

// Critically damped spring for position and direction. The depth follows the surface below the
// current position of the hand, not below its target.
void Hand::step_pointer() {
  const double omega = options_.eagerness_hz;
  const Isometry T_model_goal = aimed_pose(pointed_);
  const Vec3 way = T_model_goal.translation() - T_model_follower_.translation();
  velocity_mm_s_ += kStep_s * (omega * omega * way - 2.0 * omega * velocity_mm_s_);
  velocity_mm_s_ = limited(velocity_mm_s_, speed_mm_s_);
  const Vec3 turn = rotation_vector(T_model_follower_.linear().transpose() * T_model_goal.linear());
  turning_rad_s_ += kStep_s * (omega * omega * turn - 2.0 * omega * turning_rad_s_);
  turning_rad_s_ = limited(turning_rad_s_, options_.turn_rad_s);
  T_model_follower_.translation() += kStep_s * velocity_mm_s_;
  T_model_follower_.linear() = T_model_follower_.linear() * rotation_of(kStep_s * turning_rad_s_);
  if (const auto depth_mm = surface_depth(scene_, sensor_, T_model_follower_)) {
    const double wanted_mm = (*depth_mm - depth_mm_) * kStep_s / kDepthSmoothing_s;
    depth_mm_ += std::clamp(wanted_mm, -kStep_s * speed_mm_s_, kStep_s * speed_mm_s_);
  }
}

Isometry Hand::T_model_sensor(double time_s) const {
  const auto later =
      std::lower_bound(recent_.begin(), recent_.end(), time_s,
                       [](const PathPose& pose, double time) { return pose.time_s < time; });
  if (later == recent_.begin()) return recent_.front().T_model_sensor;
  if (later == recent_.end()) return recent_.back().T_model_sensor;
  const PathPose& before = *(later - 1);
  return interpolate(before.T_model_sensor, later->T_model_sensor,
                     (time_s - before.time_s) / (later->time_s - before.time_s));
}

device::HandAim Hand::aim() const {
  if (mode_ == device::HandMode::kPointer) return pointed_;
  const Isometry& T_model_hand = recent_.back().T_model_sensor;
  return {T_model_hand.translation(), -T_model_hand.linear().col(2), T_model_hand.linear().col(0)};
}

}  // namespace flytri::simulated
