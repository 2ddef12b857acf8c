#include "hw/simulated/sensor_calibration.h"

#include <fmt/format.h>

#include "core/calibrating/calibrate.h"
#include "core/interchange/calibration_file.h"
#include "core/interchange/file_bytes.h"
#include "hw/simulated/sensor_fingerprint.h"
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

Result<Calibration> kept_sensor_calibration(const SensorModel& sensor,
                                            const std::filesystem::path& folder,
                                            const Workers& workers, const Progress& progress) {
  const auto file = folder / fmt::format("virtual-sensor-{:016x}.json", fingerprint(sensor));
  if (auto kept = read_calibration(file)) return kept;
  auto calibration = calibrate_virtual_sensor(sensor, workers, progress);
  if (!calibration) return calibration;
  // What cannot be kept costs but the time the next time.
  if (create_folder(folder)) {
    [[maybe_unused]] const auto written = write_calibration(file, *calibration);
  }
  return calibration;
}

}  // namespace flytri
