/// @file  A hand that moves the virtual sensor: along a planned path, after a pointer, or off.
#pragma once

#include <deque>

#include "core/base/result.h"
#include "hw/device/steerable_hand.h"
#include "hw/simulated/hand/aimed_pose.h"
#include "hw/simulated/optics/sensor_path.h"

namespace flytri::simulated {

struct HandOptions {
  /// > 0, widths of the measurement volume a second, while scanning: a calm hand's 20 mm for teeth.
  double speed_widths_s = 1.0;
  double turn_rad_s = 0.8;  ///< > 0, while scanning
  /// > 0, times as fast while the sensor is in the air: nothing is measured then.
  double air_factor = 6.0;
  /// 1..20 /s, how eagerly it follows a pointer: it needs about three times the inverse to arrive.
  double eagerness_hz = 5.0;
  [[nodiscard]] Result<void> validate() const;
};

/// Follows what it is told in steps of equal length, so that the same orders at the same times give
/// the same poses. On the path it turns around at the ends and goes back the way it came: who looks
/// on sees the model grow, then become denser. Every change of mode starts from where it is. From
/// the air it comes back to where it left the path, and holds still there for a moment.
class Hand {
 public:
  Hand(RayScene scene, SensorModel sensor, SensorPath path, const HandOptions& options);

  /// Orders are valid from the time that the hand was last advanced to.
  void follow_path();
  void follow_pointer(const device::HandAim& aim);
  void take_away();

  /// Moves on until `time_s`; earlier times than before do nothing. Starts at 0.
  void advance(double time_s);

  /// Between the latest quarter of a second and the time it was advanced to.
  [[nodiscard]] Isometry T_model_sensor(double time_s) const;
  [[nodiscard]] device::HandMode mode() const { return mode_; }
  [[nodiscard]] device::HandAim aim() const;

 private:
  // Where the hand would be had it always been in this mode.
  [[nodiscard]] Isometry goal() const;
  void change_mode(device::HandMode mode);
  void step();
  void step_path();
  void step_pointer();

  RayScene scene_;
  SensorModel sensor_;
  SensorPath path_;
  HandOptions options_;
  double speed_mm_s_;

  device::HandMode mode_ = device::HandMode::kPath;
  std::deque<PathPose> recent_;

  double path_s_ = 0.0;     // on the path, from its start
  double path_pace_ = 0.0;  // path seconds a second: 1 there, -1 back, in between at the ends
  bool forwards_ = true;
  double hold_s_ = 0.0;  // for which it stays where it is on the path

  device::HandAim pointed_;                           // what the pointer says
  Isometry T_model_follower_ = Isometry::Identity();  // runs after it
  Vec3 velocity_mm_s_ = Vec3::Zero();                 // of the follower, model frame
  Vec3 turning_rad_s_ = Vec3::Zero();                 // likewise, follower frame
  double depth_mm_ = 0.0;  // from the follower to the surface, as a hand follows it

  Isometry T_model_away_ = Isometry::Identity();

  // From the goal to the hand when the mode changed; it fades in `fade_s_`.
  Isometry T_goal_hand_ = Isometry::Identity();
  double faded_s_ = 0.0;
  double fade_s_ = 0.0;
};

}  // namespace flytri::simulated
