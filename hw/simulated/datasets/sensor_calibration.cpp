#include "hw/simulated/datasets/sensor_calibration.h"

#include <fmt/format.h>

#include "core/calibration/fit/calibrate.h"
#include "core/io/calibrations/calibration_file.h"
#include "core/io/files/file_bytes.h"
#include "hw/simulated/datasets/simulate_calibration_set.h"
#include "hw/simulated/optics/sensor_fingerprint.h"

namespace flytri::simulated {
namespace {

Result<calibration::Calibration> shipped_calibration(const SensorModel& sensor,
                                                     const std::filesystem::path& folder) {
  if (folder.empty()) return fail(ErrorCode::kNotFound, "no calibration is shipped");
  return io::read_calibration(sensor_calibration_file(sensor, folder));
}

}  // namespace

Result<calibration::Calibration> calibrate_virtual_sensor(const SensorModel& sensor,
                                                          const Workers& workers,
                                                          const Progress& progress) {
  CalibrationSetOptions options;
  options.sensor = sensor;
  const auto set = take_calibration_set(options, workers, progress);
  if (!set) return tl::unexpected(set.error());
  return calibration::calibrate(*set, {}, workers, progress);
}

std::filesystem::path sensor_calibration_file(const SensorModel& sensor,
                                              const std::filesystem::path& folder) {
  return folder / fmt::format("virtual-sensor-{:016x}.json", fingerprint(sensor));
}

Result<calibration::Calibration> cached_sensor_calibration(const SensorModel& sensor,
                                                           const CalibrationFolders& folders,
                                                           const Workers& workers,
                                                           const Progress& progress) {
  const auto file = sensor_calibration_file(sensor, folders.cache);
  if (auto kept = io::read_calibration(file)) return kept;
  auto calibration = shipped_calibration(sensor, folders.shipped);
  if (!calibration) calibration = calibrate_virtual_sensor(sensor, workers, progress);
  if (!calibration) return calibration;
  // A failed write is harmless: next time the calibration is made again.
  if (io::create_folder(folders.cache)) {
    [[maybe_unused]] const auto written = io::write_calibration(file, *calibration);
  }
  return calibration;
}

}  // namespace flytri::simulated
