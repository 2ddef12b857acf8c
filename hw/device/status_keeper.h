/// @file  Thread-safe storage of a sensor's status.
#pragma once

#include <mutex>
#include <string>

#include "hw/device/sensor.h"

namespace flytri::device {

class StatusKeeper {
 public:
  /// Sets the state to kRunning and resets counts and message.
  void restart();
  void set(SensorState state, std::string message = {});
  void count_delivered();
  void count_dropped(std::int64_t frames);
  [[nodiscard]] SensorStatus status() const;
  [[nodiscard]] SensorState state() const;

 private:
  mutable std::mutex mutex_;
  SensorStatus status_;
};

}  // namespace flytri::device
