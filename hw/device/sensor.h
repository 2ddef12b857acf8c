/// @file  What delivers frames: live, replayed and simulated sensors behind one interface.
///
///                       device gone
///          start      ┌─────────────▶ lost ──┐
///     idle ─────▶ running ◀───────────┘      │
///                 │  │  │   device is back   │
///                 │  │  └──────▶ failed ◀────┘   for good; the message names the remedy
///                 │  └─────────▶ ended           a recording is over
///                 ▼
///     idle ◀── stop, from every state
///
/// start() leads from idle, ended and failed to running; times and counts begin anew.
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
  std::string message;         ///< what is wrong and its remedy; empty where nothing is
  std::int64_t delivered = 0;  ///< frames that next() returned since start()
  std::int64_t dropped = 0;    ///< frames that the source could not deliver, and knows of
};

/// A source of frames. start, stop and next are called from one thread at a time (the capture
/// loop's), all else from any thread at any time.
class Sensor {
 public:
  virtual ~Sensor() = default;
  Sensor(const Sensor&) = delete;
  Sensor& operator=(const Sensor&) = delete;

  /// Begins to deliver. Does nothing where it runs already.
  /// @errors  What kept it from running; the state is then kFailed and the message the error's.
  [[nodiscard]] virtual Result<void> start() = 0;

  /// Ends the stream, finishes what is queued and lets the device go; start() may follow.
  virtual void stop() = 0;

  /// The next frame. `time_s` counts from start() and rises from frame to frame, `index` counts the
  /// frames from 0; nothing else is promised of gaps: what was dropped is counted in the status.
  /// @param timeout_s  blocks at most that long, apart from the work on a single frame
  /// @return  nothing: no frame yet; for the reason see the state
  /// @errors  The one that made the state kFailed, as often as it is asked; kBadOption: not
  /// started.
  [[nodiscard]] virtual Result<std::optional<Frame>> next(double timeout_s) = 0;

  /// Work beside the stream that must not hold up next(): decoding ahead, writing to disk. The
  /// capture loop calls it over and over from a second thread, until just before stop().
  /// @param timeout_s  waits at most that long for work to come
  /// @return  false: there is none now
  virtual bool work_in_background(double timeout_s) {
    (void)timeout_s;
    return false;
  }
  /// Whether work_in_background ever does anything: no thread is started for nothing.
  [[nodiscard]] virtual bool has_background_work() const { return false; }

  [[nodiscard]] virtual SensorStatus status() const = 0;

  /// Of the sensor that took the frames; null where the source has none to offer.
  [[nodiscard]] virtual std::shared_ptr<const calibration::Calibration> calibration() const = 0;

  /// What a user calls it, e.g. "virtual sensor" or the folder of a recording.
  [[nodiscard]] virtual std::string name() const = 0;

 protected:
  Sensor() = default;
};

}  // namespace flytri::device
