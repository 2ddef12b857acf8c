/// @file  Simulates the hand that moves the virtual sensor: along a path, to a pointer, or lifted
/// off.
#pragma once

#include <deque>

#include "core/base/result.h"
#include "hw/device/steerable_hand.h"
#include "hw/simulated/hand/aimed_pose.h"
#include "hw/simulated/optics/sensor_path.h"

namespace flytri::simulated {

struct HandOptions {
  /// > 0. Speed while scanning, in widths of the measurement volume per second; 1 is a calm 20 mm/s
  /// for the intra-oral sensor.
  double speed_widths_s = 1.0;
  double turn_rad_s = 0.8;  ///< > 0, rotation speed while scanning
  /// > 0. Speed factor while the sensor is lifted off.
  double air_factor = 6.0;
  /// 1..20 Hz. How quickly the hand follows the pointer; it arrives after about 3 / eagerness_hz.
  double eagerness_hz = 5.0;
  [[nodiscard]] Result<void> validate() const;
};

/// Moves in time steps of equal length, so that equal requests at equal times give equal poses. At
/// the ends of the path it reverses. Every mode change starts from the current pose. After being
/// lifted off, it returns to where it left the path and holds still there for a moment.
class Hand {
 public:
  Hand(RayScene scene, SensorModel sensor, SensorPath path, const HandOptions& options);

  /// A request applies from the time of the last advance().
  void follow_path();
  void follow_pointer(const device::HandAim& aim);
  void take_away();

  /// Moves until `time_s`, starting from 0. Does nothing if that time has already passed.
  void advance(double time_s);

  /// The pose at a time within the last 0.25 s before the time of the last advance().
  [[nodiscard]] Isometry T_model_sensor(double time_s) const;
  [[nodiscard]] device::HandMode mode() const { return mode_; }
  [[nodiscard]] device::HandAim aim() const;

 private:
  // The pose without the transition from the previous mode.
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

  double path_s_ = 0.0;  // position on the path, as time from its start
  // Path seconds per second: 1 forwards, -1 backwards, in between at the ends.
  double path_pace_ = 0.0;
  bool forwards_ = true;
  double hold_s_ = 0.0;  // remaining time of holding still

  device::HandAim pointed_;                           // target of the pointer
  Isometry T_model_follower_ = Isometry::Identity();  // follows the pointer
  Vec3 velocity_mm_s_ = Vec3::Zero();                 // of the follower, in the model frame
  Vec3 turning_rad_s_ = Vec3::Zero();                 // of the follower, in its frame
  double depth_mm_ = 0.0;  // smoothed depth from the follower to the surface

  Isometry T_model_away_ = Isometry::Identity();

  // Offset from goal to hand at the mode change; decreases to zero within `fade_s_`.
  Isometry T_goal_hand_ = Isometry::Identity();
  double faded_s_ = 0.0;
  double fade_s_ = 0.0;
};

}  // namespace flytri::simulated
