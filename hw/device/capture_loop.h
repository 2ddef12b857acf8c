/// @file  Reads a sensor on its own thread and passes on each frame.
#pragma once

#include <functional>
#include <memory>

#include "core/base/result.h"
#include "hw/device/sensor.h"

namespace flytri::device {

/// Runs a sensor from construction to destruction. While the sensor is lost, the loop keeps polling
/// it. When the sensor ended or failed, the loop stops polling and waits for stop().
class CaptureLoop {
 public:
  /// Receives each frame, in order, on the loop's thread. Must not block, or frames get lost.
  using Sink = std::function<void(Frame)>;

  /// Starts the sensor on a new thread, and a second thread if the sensor has background work.
  CaptureLoop(std::shared_ptr<Sensor> sensor, Sink sink);
  /// Calls stop().
  ~CaptureLoop();

  /// Returns when the last call of the sink has returned and the sensor has finished its queued
  /// work. The former takes at most 0.05 s plus the work on one frame. May be called twice.
  void stop();

  [[nodiscard]] SensorStatus status() const;

 private:
  struct Threads;
  std::unique_ptr<Threads> threads_;
};

}  // namespace flytri::device
