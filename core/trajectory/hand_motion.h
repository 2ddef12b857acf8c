/// @file  Predicts the next pose of a hand, and how far off it may be in each direction. The
///        surface need not fix all directions of the poses before.
#pragma once

#include <optional>

#include "core/geometry/decompositions.h"
#include "core/registration/pose_solver.h"

namespace flytri::trajectory {

/// Unknowns as in registration::StepFrame, along world axes, mm: rotation about a center times the
/// arm, then translation.
struct MotionPrediction {
  Isometry T_world_sensor = Isometry::Identity();
  Vec3 center_mm = Vec3::Zero();             ///< of the view, world frame
  Matrix6 covariance = Matrix6::Identity();  ///< of the pose, mm^2
};

/// A Kalman filter of constant velocity. The hand's accelerations are white noise; how strong they
/// are is learned where the surface fixes the poses.
/// @source  Bar-Shalom, Li, Kirubarajan, "Estimation with Applications to Tracking and Navigation",
///          2001, 6.2.2 (continuous white noise acceleration).
class HandMotion {
 public:
  /// @param arm_mm  > 0, radius of a view: converts rotation to distance
  explicit HandMotion(double arm_mm) : arm_mm_(arm_mm) {}

  /// The pose at a later time, and its covariance. nullopt: not known, as after a gap.
  /// @param center_mm  of the view, sensor frame
  [[nodiscard]] std::optional<MotionPrediction> predict(double time_s, const Vec3& center_mm) const;

  /// What a view says about its pose.
  struct Measured {
    double time_s = 0.0;
    Isometry T_world_sensor = Isometry::Identity();
    Vec3 center_mm = Vec3::Zero();          ///< sensor frame
    Matrix6 information = Matrix6::Zero();  ///< of its profiles alone, mm^-2
    /// The pose is the most likely one of profiles and prediction together, not of the profiles
    /// alone.
    bool is_held = false;
  };
  void add(const Measured& measured);
  /// The latest pose has been changed.
  void move(double time_s, const Isometry& T_world_sensor);
  /// Covariance of the latest pose.
  [[nodiscard]] Matrix6 covariance() const { return state_.covariance.topLeftCorner<6, 6>(); }

 private:
  using Matrix12 = Eigen::Matrix<double, 12, 12>;

  struct State {
    double time_s = 0.0;
    Isometry T_world_sensor = Isometry::Identity();
    Vec3 center_mm = Vec3::Zero();  ///< world frame
    Twist velocity_mm_s = Twist::Zero();
    Matrix12 covariance = Matrix12::Zero();  ///< of pose and velocity
  };
  [[nodiscard]] State predicted(double time_s, const Vec3& center_mm) const;
  void start(const Measured& measured);
  void learn(const Twist& error_mm, const Matrix6& covariance);

  double arm_mm_;
  bool is_started_ = false;
  State state_;
  double unsteadiness_mm2_s3_ = 0.0;  ///< spectral density of the acceleration
};

}  // namespace flytri::trajectory
