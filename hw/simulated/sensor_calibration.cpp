#include "hw/simulated/sensor_calibration.h"

#include "core/calibrating/calibrate.h"
#include "hw/simulated/simulate_calibration_set.h"

namespace flytri {

Result<Calibration> calibrate_virtual_sensor(const SensorModel& sensor, const Workers& workers,
                                             const Progress& progress) {
  CalibrationSetOptions options;
  options.sensor = sensor;
  const auto set = take_calibration_set(options, workers, progress);
  if (!set) return tl::unexpected(set.error());
  return calibrate(*set, {}, workers, progress);
}

}  // namespace flytri
