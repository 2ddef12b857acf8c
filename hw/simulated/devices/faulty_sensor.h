/// @file  Makes any sensor fail as real ones do: frames are lost, late or unlabelled, the device
/// goes.
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

/// What happens to how many of the frames; all chances are drawn from the seed, by frame.
struct FaultOptions {
  double dropped_share = 0.0;  ///< 0..1, frames that never arrive
  double delayed_share = 0.0;  ///< 0..1, frames that arrive late, and what follows them with them
  double max_delay_s = 0.1;    ///< >= 0
  double unknown_share = 0.0;  ///< 0..1, measurement frames whose pattern is not known
  double lost_share = 0.0;     ///< 0..1, frames at which the device goes away ...
  int max_lost_frames = 30;    ///< >= 1, ... until at most so many have passed
  std::int64_t fails_after = -1;  ///< frames until it fails for good; below 0: never
  std::uint64_t seed = 1;
  [[nodiscard]] Result<void> validate() const;
};

/// A decorator around any sensor, for tests of everything behind it. The same seed over the same
/// frames gives the same faults. After it failed for good, start() makes it whole again.
class FaultySensor final : public device::Sensor {
 public:
  /// @errors  kBadOption.
  [[nodiscard]] static Result<std::shared_ptr<FaultySensor>> create(
      std::shared_ptr<device::Sensor> sensor, const FaultOptions& options, device::Clock clock);

  [[nodiscard]] Result<void> start() override;
  void stop() override;
  [[nodiscard]] Result<std::optional<Frame>> next(double timeout_s) override;
  bool work_in_background(double timeout_s) override {
    return sensor_->work_in_background(timeout_s);
  }
  [[nodiscard]] bool has_background_work() const override { return sensor_->has_background_work(); }
  /// Dropped frames are those of the sensor within and those that were made to be.
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

  // Of the thread that calls next().
  std::int64_t count_ = 0;     // frames of the sensor within
  int lost_frames_ = 0;        // until the device is back
  std::optional<Frame> held_;  // late
  double release_s_ = 0.0;
};

}  // namespace flytri::simulated
