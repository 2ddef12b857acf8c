/// @file  A guided calibration without devices: the virtual sensor in front of its targets.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "hw/shots/shot_source.h"
#include "hw/simulated/datasets/calibration_camera.h"

namespace flytri::shots {

/// What goes wrong until it is set right; for tests.
struct SimulatedMishap {
  double depth_error_mm = 0.0;                   ///< the stage stands so much too far
  bool lights_swapped = false;                   ///< vertical and horizontal
  bool lights_stay_on = false;                   ///< dark images show the vertical lines
  cv::Rect covered;                              ///< of the image: something black lies there
  std::optional<simulated::SensorModel> sensor;  ///< another exposure, another focus
};

class SimulatedShots final : public ShotSource {
 public:
  /// The sensor's exposure is shortened so that the white plane does not clip at the volume's near
  /// end.
  /// @errors  As CalibrationCamera::create.
  [[nodiscard]] static Result<std::unique_ptr<SimulatedShots>> create(
      const simulated::SensorModel& sensor,
      const simulated::CalibrationCamera::Options& options = {});

  [[nodiscard]] Result<void> start() override { return {}; }
  void stop() override {}
  [[nodiscard]] Result<cv::Mat> take(calibration::ShotKind kind, double z_mm,
                                     const Progress& progress) override;
  [[nodiscard]] Result<cv::Mat> look(calibration::ShotKind kind, double z_mm,
                                     const Progress& progress) override;
  [[nodiscard]] std::string name() const override { return "virtual sensor"; }

  /// The sensor as it takes the shots, for mishaps that change it.
  [[nodiscard]] const simulated::SensorModel& sensor() const { return sensor_; }
  /// @errors  As create.
  [[nodiscard]] Result<void> set_mishap(const SimulatedMishap& mishap);

 private:
  SimulatedShots(const simulated::SensorModel& sensor,
                 const simulated::CalibrationCamera::Options& options,
                 simulated::CalibrationCamera camera);
  [[nodiscard]] cv::Mat shoot(calibration::ShotKind kind, double z_mm);

  simulated::SensorModel sensor_;
  simulated::CalibrationCamera::Options options_;
  simulated::CalibrationCamera camera_;
  SimulatedMishap mishap_;
  std::uint64_t stream_ = 0;
};

/// A millimeter apart in a volume 15 mm deep.
inline constexpr int kUsualPlanes = 17;

/// What a guided calibration of this sensor takes.
/// @param plane_count  at equal distances through a little more than the volume
[[nodiscard]] calibration::CalibrationPlan plan_of(const simulated::SensorModel& sensor,
                                                   int plane_count = kUsualPlanes);

}  // namespace flytri::shots
