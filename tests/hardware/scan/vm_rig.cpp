#include "tests/hardware/scan/vm_rig.h"

namespace flytri::scan {

rig::RigSettings vm_rig(const simulated::SensorModel& sensor,
                        const std::optional<std::filesystem::path>& calibration) {
  rig::RigSettings rig;
  rig.name = "virtual machine";
  rig.measurement.match.serial = "M0001";
  rig.measurement.settings.size = sensor.camera.size;
  rig.measurement.settings.rate_hz = kRate_hz;
  rig.measurement.settings.exposure_s = sensor.exposure_s;
  rig::RigCamera texture;
  texture.match.serial = "C0002";
  texture.settings.format = device::PixelFormat::kMjpeg;
  texture.settings.channels = device::Channels::kRgb;
  texture.settings.size = sensor.texture_camera.size;
  texture.settings.rate_hz = kRate_hz;
  texture.settings.exposure_s = sensor.exposure_s;
  rig.texture = texture;
  rig.lights.chip.label = "ftdi-cbus";
  rig.lights.vertical.offset = 0;
  rig.lights.horizontal.offset = 1;
  rig.lights.flash.emplace().offset = 2;
  rig.flash_period_s = kFlashPeriod_s;
  // At this rate, a shot of 16 exposures takes four seconds.
  constexpr device::LightLimit kLong = {10.0, 0.9};
  rig.lights.limits = {kLong, kLong, kLong};
  rig.calibration = calibration;
  return rig;
}

}  // namespace flytri::scan
