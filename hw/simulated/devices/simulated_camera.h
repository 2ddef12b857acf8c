/// @file  A camera that is none: it shows what the lights lit, as late and as mixed as real ones
/// do.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>

#include "core/base/random.h"
#include "hw/device/camera.h"
#include "hw/device/clock.h"
#include "hw/simulated/devices/simulated_lights.h"

namespace flytri::simulated {

struct SimulatedCameraOptions {
  device::CameraSettings settings;
  double exposure_s = 0.01;    ///< > 0, of each row
  double readout_s = 0.0;      ///< >= 0, by which the last row is later than the first; 0: global
  double latency_s = 0.04;     ///< from the middle of the whole exposure to the stamp
  double phase_s = 0.0;        ///< by which all exposures are later
  double jitter_s = 0.0;       ///< >= 0, by which a stamp may be later still
  double dropped_share = 0.0;  ///< 0..1, frames that never arrive
  double noise = 0.0;          ///< >= 0, standard deviation, of full scale
  std::uint64_t seed = 1;
  std::string name = "simulated camera";
  [[nodiscard]] Result<void> validate() const;
};

/// When a frame was exposed, on the clock of the lights.
struct ExposureSpan {
  double middle_s = 0.0;
  double begin_s = 0.0;  ///< of the first row
  double end_s = 0.0;    ///< of the last row
};

/// Exposures begin at equal times, whether the frames are taken or not. A frame in which the light
/// changes shows a mixture by the share of each, row by row.
class SimulatedCamera final : public device::Camera {
 public:
  /// The scene under one light alone, around that time; all of one size and type.
  using Scene = std::function<cv::Mat(device::Light light, double time_s)>;

  /// @param options  valid ones
  SimulatedCamera(const SimulatedCameraOptions& options, Scene scene,
                  std::shared_ptr<SimulatedLights> lights, device::Clock clock);

  [[nodiscard]] Result<void> start() override;
  void stop() override;
  [[nodiscard]] Result<std::optional<device::CameraFrame>> next(double timeout_s) override;
  [[nodiscard]] device::CameraStatus status() const override;
  [[nodiscard]] device::CameraSettings requested() const override { return options_.settings; }
  [[nodiscard]] device::CameraSettings read_back() const override { return options_.settings; }
  [[nodiscard]] std::string name() const override { return options_.name; }

  /// Truth, by the number that a frame carries.
  [[nodiscard]] ExposureSpan exposure(std::int64_t sequence) const;
  /// Unplugged or plugged in again.
  void set_plugged(bool is_plugged);

 private:
  [[nodiscard]] double period_s() const { return 1.0 / options_.settings.rate_hz; }
  [[nodiscard]] double stamp_s(std::int64_t sequence) const;
  [[nodiscard]] cv::Mat expose(std::int64_t sequence) const;

  const SimulatedCameraOptions options_;
  const Scene scene_;
  const std::shared_ptr<SimulatedLights> lights_;
  const device::Clock clock_;
  double start_s_ = 0.0;
  std::int64_t sequence_ = 0;  // the next one

  mutable std::mutex mutex_;  // of all below
  device::CameraStatus status_;
  bool is_plugged_ = true;
};

}  // namespace flytri::simulated
