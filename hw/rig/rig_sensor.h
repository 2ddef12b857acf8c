/// @file  Combines the cameras and lights of a rig into one sensor that delivers labeled frames.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "hw/device/clock.h"
#include "hw/device/light_limits.h"
#include "hw/device/light_switch.h"
#include "hw/device/sensor.h"
#include "hw/device/status_keeper.h"
#include "hw/rig/frame_merger.h"
#include "hw/rig/rig.h"
#include "hw/sync/light_plan.h"

namespace flytri::rig {

struct RigSensorOptions {
  std::string name = "rig";
  double flash_period_s = 1.0;         ///< > 0
  double measurement_readout_s = 0.0;  ///< >= 0, see RigCamera::readout_s
  double texture_readout_s = 0.0;      ///< >= 0
  /// 0.05..1. How far ahead light requests are posted; longer than a call of next().
  double ahead_s = 0.2;
  /// >= 0. Longest time that a measurement frame waits for the texture frame before it.
  double patience_s = 0.25;
  device::LightLimits limits;  ///< of the light switch; the plan keeps them
  [[nodiscard]] Result<void> validate() const;
};

struct RigDevices {
  std::shared_ptr<device::Camera> measurement;
  std::shared_ptr<device::Camera> texture;  ///< null: no texture
  std::shared_ptr<device::LightSwitch> lights;
  device::Clock clock;  ///< clock of all camera stamps and light times
};

/// Runs the light sequence of the paper (section "Sensor Setup"): the patterns alternate, and about
/// once a second there is a flash for the texture camera. Frames whose light is uncertain are
/// skipped and counted. The sensor is lost while the measurement camera or the light switch is
/// lost. If the texture camera is lost, the sensor continues and the status has a message. All
/// lights are dark after stop().
class RigSensor final : public Rig {
 public:
  /// @param calibration  of this rig; may be null
  /// @errors  kBadOption. start(): as Camera::start and LightSwitch::start; kBadOption if flashes
  /// at
  ///          this period exceed a limit.
  [[nodiscard]] static Result<std::shared_ptr<RigSensor>> create(
      RigDevices devices, const RigSensorOptions& options,
      std::shared_ptr<const calibration::Calibration> calibration);

  [[nodiscard]] Result<void> start() override;
  void stop() override;
  [[nodiscard]] Result<std::optional<Frame>> next(double timeout_s) override;
  /// The lights are dark after `ahead_s`. The latency stays known.
  void rest(bool rests) override;
  /// Dropped frames: missing or damaged frames of the measurement camera, and late frames of both
  /// cameras.
  [[nodiscard]] device::SensorStatus status() const override;
  [[nodiscard]] std::shared_ptr<const calibration::Calibration> calibration() const override {
    return calibration_;
  }
  [[nodiscard]] std::string name() const override { return options_.name; }

  [[nodiscard]] RigStatus rig_status() const override;

 private:
  RigSensor(RigDevices devices, const RigSensorOptions& options,
            std::shared_ptr<const calibration::Calibration> calibration);

  [[nodiscard]] Result<void> start_devices();
  [[nodiscard]] Result<int> plan_flash() const;
  [[nodiscard]] Result<void> fail_for_good(const Error& error);
  void plan_lights();
  void report_switching();
  [[nodiscard]] Result<void> read_measurement(double timeout_s);
  void read_texture();
  [[nodiscard]] std::optional<Frame> release();
  void note_status();

  const RigDevices devices_;
  const RigSensorOptions options_;
  const std::shared_ptr<const calibration::Calibration> calibration_;
  device::StatusKeeper status_;

  // Used only by the thread that calls next().
  RigCameraReader measurement_;
  std::optional<RigCameraReader> texture_;
  sync::LightPlan plan_;
  std::optional<Error> failure_;
  std::string texture_failure_;  // the texture camera failed permanently
  bool is_away_ = false;
  bool is_resting_ = false;
  FrameMerger merger_;

  std::atomic<bool> rests_ = false;  // as the caller of rest() wants

  mutable std::mutex mutex_;  // guards all members below
  RigStatus rig_status_;
};

}  // namespace flytri::rig
