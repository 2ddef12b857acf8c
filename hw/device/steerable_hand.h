/// @file  The hand that holds a simulated sensor, for a user to steer with mouse and keys.
#pragma once

#include <optional>

#include "core/geometry/rigid.h"

namespace flytri::device {

/// kPath: along a planned path over the object. kPointer: where the user points. kAway: lifted off,
/// nothing in the measurement volume.
enum class HandMode { kPath, kPointer, kAway };

/// What the hand is to look at, model frame.
struct HandAim {
  Vec3 target_mm = Vec3::Zero();  ///< on the surface or near it: the hand keeps its distance itself
  Vec3 towards_sensor = Vec3::UnitZ();  ///< unit, from the target to the sensor: the tilt
  /// Where the sensor's x is to point; what lies along `towards_sensor` is left out. Zero: as it
  /// is.
  Vec3 along = Vec3::Zero();
};

/// Steering. The hand is no robot: it goes on from where it is, smoothly, and at a limited speed.
/// All members are thread-safe.
class SteerableHand {
 public:
  virtual ~SteerableHand() = default;

  /// Back to the planned path, which goes on where it was left.
  virtual void follow_path() = 0;
  /// To the place that the user points at; called again whenever it moves.
  virtual void follow_pointer(const HandAim& aim) = 0;
  /// Lifts the sensor off. follow_path or follow_pointer puts it back.
  virtual void take_away() = 0;

  [[nodiscard]] virtual HandMode mode() const = 0;
  /// What the hand looks at in the latest frame, so that steering may be relative to it.
  [[nodiscard]] virtual HandAim aim() const = 0;
  /// The first point of the object on a ray in the model frame, for pointing at the object itself.
  [[nodiscard]] virtual std::optional<Vec3> pick(const Vec3& origin_mm,
                                                 const Vec3& direction) const = 0;
  /// Truth: the sensor's pose at the latest frame that was delivered.
  [[nodiscard]] virtual Isometry T_model_sensor() const = 0;
};

}  // namespace flytri::device
