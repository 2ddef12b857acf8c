/// @file  Keeps a sensor's status so that one thread may write and all may read it.
#pragma once

#include <mutex>
#include <string>

#include "hw/device/sensor.h"

namespace flytri::device {

/// All members are thread-safe.
class StatusKeeper {
 public:
  /// Running, nothing counted, nothing wrong.
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
