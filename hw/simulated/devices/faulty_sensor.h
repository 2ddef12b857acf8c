/// @file  Wraps a sensor and simulates faults: lost, late or unlabeled frames, disconnections.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "core/base/result.h"
#include "hw/device/clock.h"
#include "hw/device/sensor.h"
#include "hw/device/status_keeper.h"

namespace flytri::simulated {

/// Probabilities of the faults, drawn per frame from the seed.
struct FaultOptions {
  double dropped_share = 0.0;     ///< 0..1, frames that are lost
  double delayed_share = 0.0;     ///< 0..1, frames that arrive late and delay those after them
  double max_delay_s = 0.1;       ///< >= 0
  double unknown_share = 0.0;     ///< 0..1, measurement frames with unknown pattern
  double lost_share = 0.0;        ///< 0..1, frames at which the device is disconnected ...
  int max_lost_frames = 30;       ///< >= 1, ... for at most this many frames
  std::int64_t fails_after = -1;  ///< frames until it fails permanently; below 0: never
  std::uint64_t seed = 1;
  [[nodiscard]] Result<void> validate() const;
};

/// A decorator for any sensor, for tests. The same seed and frames give the same faults. After a
/// permanent failure, start() repairs the sensor.
class FaultySensor final : public device::Sensor {
 public:
  /// @errors  kBadOption.
  [[nodiscard]] static Result<std::shared_ptr<FaultySensor>> create(
      std::shared_ptr<device::Sensor> sensor, const FaultOptions& options, device::Clock clock);

  [[nodiscard]] Result<void> start() override;
  void stop() override;
  [[nodiscard]] Result<std::optional<Frame>> next(double timeout_s) override;
  void rest(bool rests) override { sensor_->rest(rests); }
  bool work_in_background(double timeout_s) override {
    return sensor_->work_in_background(timeout_s);
  }
  [[nodiscard]] bool has_background_work() const override { return sensor_->has_background_work(); }
  /// Counts the frames dropped by the wrapped sensor and by this class.
  [[nodiscard]] device::SensorStatus status() const override;
  [[nodiscard]] std::shared_ptr<const calibration::Calibration> calibration() const override {
    return sensor_->calibration();
  }
  [[nodiscard]] std::string name() const override { return sensor_->name(); }

 private:
  FaultySensor(std::shared_ptr<device::Sensor> sensor, const FaultOptions& options,
               device::Clock clock);

  [[nodiscard]] std::optional<Frame> pass(Frame frame);
  [[nodiscard]] std::optional<Frame> release(double timeout_s);

  const std::shared_ptr<device::Sensor> sensor_;
  const FaultOptions options_;
  const device::Clock clock_;
  device::StatusKeeper status_;

  // Used only by the thread that calls next().
  std::int64_t count_ = 0;     // frames of the wrapped sensor
  int lost_frames_ = 0;        // frames until the device is back
  std::optional<Frame> held_;  // delayed frame
  double release_s_ = 0.0;
};

}  // namespace flytri::simulated
