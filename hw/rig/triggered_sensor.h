/// @file  A rig whose light switch triggers the cameras: each exposure sees one light, by wire.
#pragma once

#include <atomic>
#include <functional>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "hw/device/clock.h"
#include "hw/device/light_limits.h"
#include "hw/device/status_keeper.h"
#include "hw/gpio/sequencer.h"
#include "hw/rig/frame_merger.h"
#include "hw/rig/rig.h"
#include "hw/rig/triggered_camera.h"

namespace flytri::rig {

struct TriggeredDevices {
  std::shared_ptr<device::Camera> measurement;
  std::shared_ptr<device::Camera> texture;  ///< null: no texture
  /// Opens the sequencer, also after it was lost.
  std::function<Result<std::unique_ptr<gpio::Sequencer>>()> open_sequencer;
  device::Clock clock;  ///< clock of all camera stamps
};

struct TriggeredSensorOptions {
  std::string name = "rig";
  double flash_period_s = 1.0;                  ///< > 0
  double measurement_readout_s = 0.0;           ///< >= 0, see RigCamera::readout_s
  double texture_readout_s = 0.0;               ///< >= 0
  int vertical = 0, horizontal = 1, flash = 2;  ///< outputs of the sequencer
  double patience_s = 0.25;  ///< >= 0, longest wait of a measurement frame for a texture frame
  device::LightLimits limits;
  [[nodiscard]] Result<void> validate() const;
};

/// Asks the sequencer for one exposure after the other: the patterns alternate, and about once a
/// second comes a flash. No latency is searched for and no frame sees two lights. The sensor is
/// lost while the sequencer or the measurement camera does not answer.
class TriggeredSensor final : public Rig {
 public:
  /// @param calibration  of this rig; may be null
  /// @errors  kBadOption. start(): as Camera::start and Sequencer::open; kBadOption if an exposure
  ///          does not fit in a period of the camera, or flashes exceed a limit.
  [[nodiscard]] static Result<std::shared_ptr<TriggeredSensor>> create(
      TriggeredDevices devices, const TriggeredSensorOptions& options,
      std::shared_ptr<const calibration::Calibration> calibration);
  ~TriggeredSensor() override { stop(); }

  [[nodiscard]] Result<void> start() override;
  void stop() override;
  [[nodiscard]] Result<std::optional<Frame>> next(double timeout_s) override;
  void rest(bool rests) override { rests_ = rests; }
  [[nodiscard]] device::SensorStatus status() const override;
  [[nodiscard]] std::shared_ptr<const calibration::Calibration> calibration() const override {
    return calibration_;
  }
  [[nodiscard]] std::string name() const override { return options_.name; }
  [[nodiscard]] RigStatus rig_status() const override;

 private:
  TriggeredSensor(TriggeredDevices devices, const TriggeredSensorOptions& options,
                  std::shared_ptr<const calibration::Calibration> calibration);
  [[nodiscard]] Result<void> plan();
  [[nodiscard]] Result<void> start_devices();
  [[nodiscard]] Result<void> fail_for_good(const Error& error);
  void find_sequencer();
  void expose_next();
  void expose(device::Light light, TriggeredCamera& camera);
  [[nodiscard]] bool is_flash_due(double now_s) const;
  [[nodiscard]] Result<void> read(double timeout_s);
  void note_status();

  const TriggeredDevices devices_;
  const TriggeredSensorOptions options_;
  const std::shared_ptr<const calibration::Calibration> calibration_;
  device::StatusKeeper status_;

  // Used only by the thread that calls next().
  std::unique_ptr<gpio::Sequencer> sequencer_;  // null: lost
  std::optional<TriggeredCamera> measurement_, texture_;
  FrameMerger merger_;
  std::optional<Error> failure_;
  std::string texture_failure_;
  std::string sequencer_message_;
  double period_s_ = 0.0;
  double pattern_s_ = 0.0, flash_s_ = 0.0;  // durations of exposures
  double next_s_ = 0.0;                     // of the next exposure
  double search_s_ = 0.0;                   // when the sequencer is searched for again
  double flashed_s_ = 0.0;                  // the latest flash
  // From the board's clock to ours: the least delay so far, which may drift.
  double clock_offset_s_ = std::numeric_limits<double>::infinity();
  double board_s_ = 0.0;
  double board_turns_s_ = 0.0;
  device::Light pattern_ = device::Light::kHorizontal;  // the latest
  device::LightSwitchStatus lights_;

  std::atomic<bool> rests_ = false;
  mutable std::mutex mutex_;  // guards the member below
  RigStatus rig_status_;
};

}  // namespace flytri::rig
