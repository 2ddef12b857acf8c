/// @file  Keeps account of how long each light was on: whether it may turn on, and when it must be
/// dark.
#pragma once

#include <array>
#include <limits>

#include "hw/device/light_limits.h"

namespace flytri::device {

/// Each light has a credit of on-time. The credit is full at the start, shrinks while the light is
/// on and grows while it is dark, so that both limits hold. A light that used up its credit rests
/// until the credit is full again: with max_on_s = 2 and max_duty = 0.25, it is on for 2 s and
/// rests for 6 s.
///
/// Allocates no memory and calls no clock, so that a forked child may use it.
class LightBudget {
 public:
  /// @param limits  must be valid
  explicit LightBudget(const LightLimits& limits);

  /// A call to the device begins that turns on `light`: it counts as on from now on, and so do the
  /// lights that were on before.
  /// @param now_s  never smaller than before; on one clock, as in all members
  void begin(Light light, double now_s);
  /// The call returned: only `light` is on.
  void finish(Light light, double now_s);

  /// kDark may always be switched.
  [[nodiscard]] bool may_turn_on(Light light, double now_s) const;
  /// When a light that is on has used up its credit; infinite while all are dark.
  [[nodiscard]] double dark_by_s() const;

 private:
  struct Account {
    LightLimit limit;
    double credit_s = 0.0;  // at time_s, in on-time without a break
    double time_s = -std::numeric_limits<double>::infinity();
    bool is_on = false;
    bool is_resting = false;
  };
  static void advance(Account& account, double now_s);
  [[nodiscard]] Account* account_of(Light light);

  std::array<Account, 3> accounts_;  // by Light, without kDark
};

}  // namespace flytri::device
