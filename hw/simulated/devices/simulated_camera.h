/// @file  Simulated camera: shows the lit scene, with the latency and mixed exposures of a real
/// one.
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
  double exposure_s = 0.01;    ///< > 0, exposure of each row
  double readout_s = 0.0;      ///< >= 0, delay of the last row after the first; 0: global shutter
  double latency_s = 0.04;     ///< from the middle of the exposure to the time stamp
  double phase_s = 0.0;        ///< delay of all exposures
  double jitter_s = 0.0;       ///< >= 0, largest random delay of a stamp
  double dropped_share = 0.0;  ///< 0..1, share of lost frames
  double noise = 0.0;          ///< >= 0, standard deviation, share of full scale
  std::uint64_t seed = 1;
  std::string name = "simulated camera";
  [[nodiscard]] Result<void> validate() const;
};

/// Exposure time of a frame, on the clock of the lights.
struct ExposureSpan {
  double middle_s = 0.0;
  double begin_s = 0.0;  ///< of the first row
  double end_s = 0.0;    ///< of the last row
};

/// Exposures start at equal intervals, whether or not the frames are fetched. If the light changes
/// during an exposure, each row shows a mixture of both lights by their share of the time.
class SimulatedCamera final : public device::Camera {
 public:
  /// The scene under one light at a time; all images have the same size and type.
  using Scene = std::function<cv::Mat(device::Light light, double time_s)>;

  /// @param options  must be valid
  SimulatedCamera(const SimulatedCameraOptions& options, Scene scene,
                  std::shared_ptr<SimulatedLights> lights, device::Clock clock);

  [[nodiscard]] Result<void> start() override;
  void stop() override;
  [[nodiscard]] Result<std::optional<device::CameraFrame>> next(double timeout_s) override;
  [[nodiscard]] device::CameraStatus status() const override;
  [[nodiscard]] device::CameraSettings requested() const override { return options_.settings; }
  [[nodiscard]] device::CameraSettings read_back() const override { return options_.settings; }
  [[nodiscard]] std::string name() const override { return options_.name; }

  /// True exposure of the frame with this sequence number.
  [[nodiscard]] ExposureSpan exposure(std::int64_t sequence) const;
  /// Simulates plugging in or unplugging the camera.
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
  std::int64_t sequence_ = 0;  // of the next frame

  mutable std::mutex mutex_;  // guards all members below
  device::CameraStatus status_;
  bool is_plugged_ = true;
};

}  // namespace flytri::simulated
