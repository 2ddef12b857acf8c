/// @file  How long and how often each light may be on.
#pragma once

#include "core/base/result.h"
#include "hw/device/light_switch.h"

namespace flytri::device {

/// Limits of one light. docs/light-safety.md says how to find them for an LED.
struct LightLimit {
  /// Above 0, at most 60 s. Longest time that the light is on without a break.
  double max_on_s = 2.0;
  /// Above 0, at most 0.95. Largest share of time that the light is on: in any T seconds it is on
  /// for at most max_duty * T + (1 - max_duty) * max_on_s.
  double max_duty = 0.6;
  [[nodiscard]] Result<void> validate() const;
};

/// The defaults end a light that was forgotten, and do not disturb a scan at 5 Hz or faster. They
/// do not make every LED safe for eyes: that depends on its power.
struct LightLimits {
  LightLimit vertical;
  LightLimit horizontal;
  LightLimit flash = {2.0, 0.25};
  /// @param light  not kDark
  [[nodiscard]] const LightLimit& of(Light light) const;
  /// The same limits times `share`, 0..1: for whoever must act before the limit is reached.
  [[nodiscard]] LightLimits tightened(double share) const;
  [[nodiscard]] Result<void> validate() const;
};

}  // namespace flytri::device
