/// @file  The thread that reads a sensor and hands each frame on.
#pragma once

#include <functional>
#include <memory>

#include "core/base/result.h"
#include "hw/device/sensor.h"

namespace flytri::device {

/// Runs a sensor from construction to destruction. The sensor's state says how it goes: a sensor
/// that is lost is asked on, one that ended or failed is let go, and the loop waits to be stopped.
class CaptureLoop {
 public:
  /// Gets each frame, in order, on the loop's thread. Must not block: the camera does not wait.
  using Sink = std::function<void(Frame)>;

  /// Starts the sensor on a thread of its own, and a second one if it has work beside the stream.
  CaptureLoop(std::shared_ptr<Sensor> sensor, Sink sink);
  /// As stop().
  ~CaptureLoop();

  /// Returns when the last call of the sink has, after no more than a twentieth of a second and the
  /// work on one frame, and when the sensor has finished what it queued. May be called twice.
  void stop();

  [[nodiscard]] SensorStatus status() const;

 private:
  struct Threads;
  std::unique_ptr<Threads> threads_;
};

}  // namespace flytri::device
