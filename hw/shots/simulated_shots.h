/// @file  Takes the shots of a guided calibration with the virtual sensor, without devices.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "hw/shots/shot_source.h"
#include "hw/simulated/datasets/calibration_camera.h"
#include "hw/simulated/datasets/simulate_board_set.h"

namespace flytri::shots {

/// Faults of the setup, for tests.
struct ShotFaults {
  double depth_error_mm = 0.0;                   ///< offset of the stage from its nominal depth
  bool lights_swapped = false;                   ///< vertical and horizontal pattern swapped
  bool lights_stay_on = false;                   ///< dark images show the vertical lines
  cv::Rect covered;                              ///< image area covered by something black
  std::optional<simulated::SensorModel> sensor;  ///< changed sensor, e.g. exposure or focus
};

class SimulatedShots final : public ShotSource {
 public:
  /// Shortens the sensor's exposure so that the white plane is not overexposed at the near end of
  /// the volume.
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
  void hold_board(const Isometry& T_sensor_board) override { T_sensor_board_ = T_sensor_board; }
  [[nodiscard]] std::string name() const override { return "virtual sensor"; }

  /// The sensor that takes the shots; a start for faults that change it.
  [[nodiscard]] const simulated::SensorModel& sensor() const { return sensor_; }
  /// @errors  As create.
  [[nodiscard]] Result<void> set_faults(const ShotFaults& faults);

 private:
  SimulatedShots(const simulated::SensorModel& sensor,
                 const simulated::CalibrationCamera::Options& options,
                 simulated::CalibrationCamera camera);
  [[nodiscard]] cv::Mat shoot(calibration::ShotKind kind, double z_mm);
  [[nodiscard]] Result<cv::Mat> shoot_board(calibration::ShotKind kind);

  simulated::SensorModel sensor_;
  simulated::CalibrationCamera::Options options_;
  simulated::CalibrationCamera camera_;
  ShotFaults faults_;
  std::uint64_t stream_ = 0;
  std::optional<Isometry> T_sensor_board_;      // none: plane and dots
  std::optional<simulated::BoardScene> board_;  // made when it is needed
};

/// Default number of planes: about one per millimeter in a volume of 15 mm depth.
inline constexpr int kUsualPlanes = 17;

/// The plan of a guided calibration of this sensor.
/// @param plane_count  planes at equal distances, reaching a little beyond the volume
[[nodiscard]] calibration::CalibrationPlan plan_of(const simulated::SensorModel& sensor,
                                                   int plane_count = kUsualPlanes);

}  // namespace flytri::shots
