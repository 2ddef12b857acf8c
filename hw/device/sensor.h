/// @file  Interface of a source of frames: a rig, a recording or a simulated sensor.
///
///                       device gone
///          start      ┌─────────────▶ lost ──┐
///     idle ─────▶ running ◀───────────┘      │
///                 │  │  │   device is back   │
///                 │  │  └──────▶ failed ◀────┘   cannot continue; the message says what to do
///                 │  └─────────▶ ended           the recording has no more frames
///                 ▼
///     idle ◀── stop, from every state
///
/// start() leads from idle, ended and failed to running, and resets times and counts.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/calibration/record/calibration.h"
#include "core/imaging/frame.h"

namespace flytri::device {

enum class SensorState { kIdle, kRunning, kLost, kEnded, kFailed };

[[nodiscard]] std::string_view to_string(SensorState state);

struct SensorStatus {
  SensorState state = SensorState::kIdle;
  std::string message;         ///< what is wrong and what to do; empty if nothing is wrong
  std::int64_t delivered = 0;  ///< frames that next() returned since start()
  std::int64_t dropped = 0;    ///< frames known to be missing
};

/// A source of frames. Call start, stop and next from one thread at a time (the capture loop's).
/// All other members are thread-safe.
class Sensor {
 public:
  virtual ~Sensor() = default;
  Sensor(const Sensor&) = delete;
  Sensor& operator=(const Sensor&) = delete;

  /// Starts the stream. Does nothing if it already runs.
  /// @errors  Why it cannot run. The state is then kFailed and the status has the error's message.
  [[nodiscard]] virtual Result<void> start() = 0;

  /// Stops the stream, finishes queued work and releases the device. start() may be called again.
  virtual void stop() = 0;

  /// The next frame. `time_s` counts from start() and increases from frame to frame; `index` counts
  /// the frames from 0. Dropped frames do not show in the index; the status counts them.
  /// @param timeout_s  longest wait, not counting the work on one frame
  /// @return  nothing if there is no frame yet; the status says why
  /// @errors  In state kFailed: the error that caused it, at every call. kBadOption: not started.
  [[nodiscard]] virtual Result<std::optional<Frame>> next(double timeout_s) = 0;

  /// Turns the lights off, and stops the frames, while nobody needs them; or turns them on again.
  /// Thread-safe. A recording ignores it.
  virtual void rest(bool rests) { (void)rests; }

  /// Does background work that must not delay next(), such as decoding ahead or writing to disk.
  /// The capture loop calls it repeatedly from a second thread, until just before stop().
  /// @param timeout_s  longest wait for work to arrive
  /// @return  false if there was no work
  virtual bool work_in_background(double timeout_s) {
    (void)timeout_s;
    return false;
  }
  /// Whether the sensor ever has background work; if not, no second thread is started.
  [[nodiscard]] virtual bool has_background_work() const { return false; }

  [[nodiscard]] virtual SensorStatus status() const = 0;

  /// The calibration of the sensor that took the frames; null if the source has none.
  [[nodiscard]] virtual std::shared_ptr<const calibration::Calibration> calibration() const = 0;

  /// Name shown to the user, e.g. "virtual sensor" or the folder of a recording.
  [[nodiscard]] virtual std::string name() const = 0;

 protected:
  Sensor() = default;
};

}  // namespace flytri::device
