/// @file  Interface to move a simulated sensor with mouse and keys, like a hand that holds it.
#pragma once

#include <optional>

#include "core/geometry/rigid.h"

namespace flytri::device {

/// kPath: moves along a planned path over the object. kPointer: follows the pointer. kAway: lifted
/// off, so that nothing is in the measurement volume.
enum class HandMode { kPath, kPointer, kAway };

/// Where the sensor shall look, in the model frame.
struct HandAim {
  Vec3 target_mm = Vec3::Zero();  ///< on or near the surface; the hand keeps the working distance
  Vec3 towards_sensor =
      Vec3::UnitZ();  ///< unit vector from the target to the sensor; sets the tilt
  /// Direction of the sensor's x axis; its component along `towards_sensor` is ignored. Zero: keep
  /// the current direction.
  Vec3 along = Vec3::Zero();
};

/// Moves the sensor like a human hand: smoothly, from its current pose, and with limited speed. All
/// members are thread-safe.
class SteerableHand {
 public:
  virtual ~SteerableHand() = default;

  /// Returns to the planned path and continues where it left.
  virtual void follow_path() = 0;
  /// Moves to the place under the pointer. Call again whenever the pointer moves.
  virtual void follow_pointer(const HandAim& aim) = 0;
  /// Lifts the sensor off. follow_path or follow_pointer puts it back.
  virtual void take_away() = 0;

  [[nodiscard]] virtual HandMode mode() const = 0;
  /// Where the sensor looked in the latest frame; a start for relative steering.
  [[nodiscard]] virtual HandAim aim() const = 0;
  /// The first point of the object on a ray in the model frame; used to point at the object.
  [[nodiscard]] virtual std::optional<Vec3> pick(const Vec3& origin_mm,
                                                 const Vec3& direction) const = 0;
  /// The true sensor pose at the latest delivered frame.
  [[nodiscard]] virtual Isometry T_model_sensor() const = 0;
};

}  // namespace flytri::device
