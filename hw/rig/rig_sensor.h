/// @file  Cameras and lights of a rig as one sensor: labeled frames in order of time.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "hw/device/clock.h"
#include "hw/device/light_switch.h"
#include "hw/device/sensor.h"
#include "hw/device/status_keeper.h"
#include "hw/rig/frame_merger.h"
#include "hw/rig/rig_camera.h"
#include "hw/sync/light_plan.h"

namespace flytri::rig {

struct RigSensorOptions {
  std::string name = "rig";
  double flash_period_s = 1.0;         ///< > 0
  double measurement_readout_s = 0.0;  ///< >= 0, see RigCamera
  double texture_readout_s = 0.0;      ///< >= 0
  /// 0.05..1. Requests for lights are posted so far ahead: longer than a call of next() takes.
  double ahead_s = 0.2;
  /// >= 0. Measurement frames wait at most so long for the texture frame before them.
  double patience_s = 0.25;
  [[nodiscard]] Result<void> validate() const;
};

struct RigDevices {
  std::shared_ptr<device::Camera> measurement;
  std::shared_ptr<device::Camera> texture;  ///< null: no texture
  std::shared_ptr<device::LightSwitch> lights;
  device::Clock clock;  ///< of the stamps of the cameras and the times of the lights
};

/// Counts since start().
struct RigStatus {
  RigCameraStatus measurement;
  std::optional<RigCameraStatus> texture;
  device::LightSwitchStatus lights;
  int frames_per_pattern = 1;
  bool keeps_step = false;  ///< the lights switch in the gaps between exposures
  std::int64_t late = 0;    ///< frames given up because a later one was delivered already
};

/// Runs the sequence of the paper: the patterns alternate, and about every second a flash lights
/// the texture camera. Frames whose light is not known for sure are left out and counted. The
/// sensor is lost while the measurement camera or the switch of the lights is; without its texture
/// camera it goes on and says so. All lights are dark after stop().
class RigSensor final : public device::Sensor {
 public:
  /// @param calibration  of this rig; null: none
  /// @errors  kBadOption.
  [[nodiscard]] static Result<std::shared_ptr<RigSensor>> create(
      RigDevices devices, const RigSensorOptions& options,
      std::shared_ptr<const calibration::Calibration> calibration);

  [[nodiscard]] Result<void> start() override;
  void stop() override;
  [[nodiscard]] Result<std::optional<Frame>> next(double timeout_s) override;
  /// Dropped frames are those of the measurement camera that are missing by its numbers or damaged,
  /// and those of either camera that were late.
  [[nodiscard]] device::SensorStatus status() const override;
  [[nodiscard]] std::shared_ptr<const calibration::Calibration> calibration() const override {
    return calibration_;
  }
  [[nodiscard]] std::string name() const override { return options_.name; }

  /// May be called from any thread.
  [[nodiscard]] RigStatus rig_status() const;

 private:
  RigSensor(RigDevices devices, const RigSensorOptions& options,
            std::shared_ptr<const calibration::Calibration> calibration);

  [[nodiscard]] Result<void> start_devices();
  [[nodiscard]] Result<void> fail_for_good(const Error& error);
  void plan_lights();
  void hear_lights();
  [[nodiscard]] Result<void> read_measurement(double timeout_s);
  void read_texture();
  [[nodiscard]] std::optional<Frame> release();
  void note_status();

  const RigDevices devices_;
  const RigSensorOptions options_;
  const std::shared_ptr<const calibration::Calibration> calibration_;
  device::StatusKeeper status_;

  // Of the thread that calls next().
  RigCameraReader measurement_;
  std::optional<RigCameraReader> texture_;
  sync::LightPlan plan_;
  std::optional<Error> failure_;
  std::string texture_failure_;  // the texture camera is gone for good
  bool is_away_ = false;
  FrameMerger merger_;

  mutable std::mutex mutex_;  // of what follows
  RigStatus rig_status_;
};

}  // namespace flytri::rig
