#include "core/trajectory/hand_motion.h"

#include <algorithm>
#include <cmath>

namespace flytri::trajectory {
namespace {

/// Speeds of a hand, standard deviation, before the first is measured.
constexpr double kUsualSpeed_mm_s = 20.0;
/// A strong tremor; what is learned soon replaces it.
constexpr double kFirstUnsteadiness_mm2_s3 = 100.0;
constexpr double kLeastUnsteadiness_mm2_s3 = 0.1, kMostUnsteadiness_mm2_s3 = 1e4;
/// Weight of one view in what is learned.
constexpr double kLearnedShare = 0.1;
/// After a longer time the hand may have done anything.
constexpr double kLongestGap_s = 0.25;

/// Converts unknowns about one center to unknowns about another.
Matrix6 about_other_center(const Vec3& moved_mm, double arm_mm) {
  Matrix6 A = Matrix6::Identity();
  const Vec3 d = moved_mm / arm_mm;
  A.bottomLeftCorner<3, 3>() << 0, d.z(), -d.y(), -d.z(), 0, d.x(), d.y(), -d.x(), 0;
  return A;
}

}  // namespace

HandMotion::State HandMotion::predicted(double time_s, const Vec3& center_mm) const {
  State next = state_;
  const double dt = time_s - state_.time_s;
  next.time_s = time_s;
  next.T_world_sensor =
      registration::motion_of(dt * state_.velocity_mm_s, {state_.center_mm, arm_mm_}) *
      state_.T_world_sensor;
  next.center_mm = next.T_world_sensor * center_mm;
  Matrix12 F = Matrix12::Identity();
  F.topRightCorner<6, 6>().diagonal().setConstant(dt);
  next.covariance = F * state_.covariance * F.transpose();
  const Matrix6 unit = unsteadiness_mm2_s3_ * Matrix6::Identity();
  next.covariance.topLeftCorner<6, 6>() += dt * dt * dt / 3.0 * unit;
  next.covariance.topRightCorner<6, 6>() += dt * dt / 2.0 * unit;
  next.covariance.bottomLeftCorner<6, 6>() += dt * dt / 2.0 * unit;
  next.covariance.bottomRightCorner<6, 6>() += dt * unit;
  Matrix12 A = Matrix12::Zero();
  A.topLeftCorner<6, 6>() = about_other_center(next.center_mm - state_.center_mm, arm_mm_);
  A.bottomRightCorner<6, 6>() = A.topLeftCorner<6, 6>();
  next.covariance = A * next.covariance * A.transpose();
  next.velocity_mm_s = A.topLeftCorner<6, 6>() * state_.velocity_mm_s;
  return next;
}

std::optional<MotionPrediction> HandMotion::predict(double time_s, const Vec3& center_mm) const {
  if (!is_started_ || time_s <= state_.time_s || time_s > state_.time_s + kLongestGap_s) {
    return std::nullopt;
  }
  const State next = predicted(time_s, center_mm);
  return MotionPrediction{next.T_world_sensor, next.center_mm,
                          next.covariance.topLeftCorner<6, 6>()};
}

void HandMotion::start(const Measured& measured) {
  is_started_ = true;
  unsteadiness_mm2_s3_ = kFirstUnsteadiness_mm2_s3;
  state_ = {measured.time_s, measured.T_world_sensor, measured.T_world_sensor * measured.center_mm};
  state_.covariance.setZero();
  state_.covariance.topLeftCorner<6, 6>() =
      inverse_of_symmetric(measured.information + Matrix6::Identity() / (arm_mm_ * arm_mm_));
  state_.covariance.bottomRightCorner<6, 6>().diagonal().setConstant(kUsualSpeed_mm_s *
                                                                     kUsualSpeed_mm_s);
}

/// The unsteadiness is right if the errors of the predictions are as large as expected.
void HandMotion::learn(const Twist& error_mm, const Matrix6& covariance) {
  const double ratio = error_mm.dot(solve_symmetric(covariance, error_mm)) / 6.0;
  unsteadiness_mm2_s3_ =
      std::clamp(unsteadiness_mm2_s3_ * std::clamp(1.0 + kLearnedShare * (ratio - 1.0), 0.5, 2.0),
                 kLeastUnsteadiness_mm2_s3, kMostUnsteadiness_mm2_s3);
}

void HandMotion::add(const Measured& measured) {
  const double gap_s = measured.time_s - state_.time_s;
  if (!is_started_ || gap_s <= 0.0 || gap_s > kLongestGap_s) return start(measured);
  State next = predicted(measured.time_s, measured.center_mm);
  const Matrix6 before = next.covariance.topLeftCorner<6, 6>();
  const Matrix6 information_before = inverse_of_symmetric(before);
  const Matrix6 after = inverse_of_symmetric(information_before + measured.information);
  Twist moved_mm = registration::unknowns_of(
      measured.T_world_sensor * next.T_world_sensor.inverse(), {next.center_mm, arm_mm_});
  if (!measured.is_held) {
    const Matrix6 noise =
        inverse_of_symmetric(measured.information + Matrix6::Identity() / (arm_mm_ * arm_mm_));
    learn(moved_mm, before + noise);
    moved_mm = after * measured.information * moved_mm;
  }
  const Matrix6 gain = next.covariance.bottomLeftCorner<6, 6>() * information_before;
  next.velocity_mm_s += gain * moved_mm;
  next.covariance.topLeftCorner<6, 6>() = after;
  next.covariance.bottomLeftCorner<6, 6>() = gain * after;
  next.covariance.topRightCorner<6, 6>() = (gain * after).transpose();
  next.covariance.bottomRightCorner<6, 6>() -= gain * (before - after) * gain.transpose();
  next.T_world_sensor = measured.T_world_sensor;
  next.center_mm = measured.T_world_sensor * measured.center_mm;
  state_ = next;
}

void HandMotion::move(double time_s, const Isometry& T_world_sensor) {
  if (!is_started_ || time_s != state_.time_s) return;
  const Isometry T_new_world = T_world_sensor * state_.T_world_sensor.inverse();
  state_.T_world_sensor = T_world_sensor;
  state_.center_mm = T_new_world * state_.center_mm;
}

}  // namespace flytri::trajectory
