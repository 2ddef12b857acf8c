/// @file  A guided calibration without devices: the virtual sensor in front of its targets.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "hw/chair/shot_source.h"
#include "hw/simulated/calibration_camera.h"

namespace flytri {

/// What goes wrong until it is set right; for tests.
struct SimulatedMishap {
  double depth_error_mm = 0.0;        ///< the stage stands so much too far
  bool lights_swapped = false;        ///< vertical and horizontal
  bool lights_stay_on = false;        ///< dark images show the vertical lines
  cv::Rect covered;                   ///< of the image: something black lies there
  std::optional<SensorModel> sensor;  ///< another exposure, another focus
};

class SimulatedShots final : public ShotSource {
 public:
  /// The sensor's exposure is shortened so that the white plane does not clip at the volume's near
  /// end.
  /// @errors  As CalibrationCamera::create.
  [[nodiscard]] static Result<std::unique_ptr<SimulatedShots>> create(
      const SensorModel& sensor, const CalibrationCamera::Options& options = {});

  [[nodiscard]] Result<void> start() override { return {}; }
  void stop() override {}
  [[nodiscard]] Result<cv::Mat> take(ShotKind kind, double z_mm, const Progress& progress) override;
  [[nodiscard]] Result<cv::Mat> look(ShotKind kind, double z_mm, const Progress& progress) override;
  [[nodiscard]] std::string name() const override { return "virtual sensor"; }

  /// The sensor as it takes the shots, for mishaps that change it.
  [[nodiscard]] const SensorModel& sensor() const { return sensor_; }
  /// @errors  As create.
  [[nodiscard]] Result<void> set_mishap(const SimulatedMishap& mishap);

 private:
  SimulatedShots(const SensorModel& sensor, const CalibrationCamera::Options& options,
                 CalibrationCamera camera);
  [[nodiscard]] cv::Mat shoot(ShotKind kind, double z_mm);

  SensorModel sensor_;
  CalibrationCamera::Options options_;
  CalibrationCamera camera_;
  SimulatedMishap mishap_;
  std::uint64_t stream_ = 0;
};

/// A millimeter apart in a volume 15 mm deep.
inline constexpr int kUsualPlanes = 17;

/// What a guided calibration of this sensor takes.
/// @param plane_count  at equal distances through a little more than the volume
[[nodiscard]] CalibrationPlan plan_of(const SensorModel& sensor, int plane_count = kUsualPlanes);

}  // namespace flytri
