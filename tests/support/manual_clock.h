/// @file  A clock that a test advances; sleeping advances it at once, so that tests do not wait.
#pragma once

#include <atomic>
#include <memory>

#include "hw/device/clock.h"

namespace flytri::testing {

/// Copies share the same time.
class ManualClock {
 public:
  void turn(double duration_s) const {
    double now_s = now_s_->load();
    while (!now_s_->compare_exchange_weak(now_s, now_s + duration_s)) {
    }
  }
  [[nodiscard]] double now_s() const { return now_s_->load(); }

  /// The clock for the devices. Its sleep function advances the time.
  [[nodiscard]] device::Clock clock() const {
    return {[self = *this] { return self.now_s(); },
            [self = *this](double duration_s) {
              if (duration_s > 0.0) self.turn(duration_s);
            }};
  }

 private:
  std::shared_ptr<std::atomic<double>> now_s_ = std::make_shared<std::atomic<double>>(100.0);
};

}  // namespace flytri::testing
