#include "hw/rig/open_rig.h"

#include "core/io/calibrations/calibration_file.h"
#include "hw/device/threaded_camera.h"
#include "hw/gpio/gpio_light_switch.h"
#include "hw/stream/streamed_camera.h"

namespace flytri::rig {

Result<std::shared_ptr<RigSensor>> assemble_rig(const RigSettings& rig, RigDevices devices) {
  if (auto valid = rig.validate(); !valid) return tl::unexpected(valid.error());
  std::shared_ptr<const calibration::Calibration> calibration;
  if (rig.calibration) {
    auto read = io::read_calibration(*rig.calibration);
    if (!read) return tl::unexpected(read.error());
    calibration = std::make_shared<const calibration::Calibration>(*std::move(read));
  }
  RigSensorOptions options;
  options.name = rig.name;
  options.flash_period_s = rig.flash_period_s;
  options.limits = rig.lights.limits;
  options.measurement_readout_s = rig.measurement.readout_s;
  if (rig.texture) options.texture_readout_s = rig.texture->readout_s;
  return RigSensor::create(std::move(devices), options, std::move(calibration));
}

Result<RigDevices> open_devices(const RigSettings& rig) {
  if (auto valid = rig.validate(); !valid) return tl::unexpected(valid.error());
  RigDevices devices;
  devices.clock = device::machine_clock();
  const CameraDrivers drivers = machine_drivers();
  const auto make_camera = [&](const RigCamera& camera) {
    return stream::StreamedCamera::create(drivers.of(camera.driver), camera.match, camera.settings);
  };
  auto measurement = make_camera(rig.measurement);
  if (!measurement) return tl::unexpected(measurement.error());
  devices.measurement = *std::move(measurement);
  if (rig.texture) {
    auto texture = make_camera(*rig.texture);
    if (!texture) return tl::unexpected(texture.error());
    // On its own thread, so that restarting this camera does not cost frames of the other.
    devices.texture = std::make_shared<device::ThreadedCamera>(*std::move(texture));
  }
  auto lights = gpio::GpioLightSwitch::create(rig.lights);
  if (!lights) return tl::unexpected(lights.error());
  devices.lights = *std::move(lights);
  return devices;
}

Result<std::shared_ptr<RigSensor>> open_rig(const RigSettings& rig) {
  auto devices = open_devices(rig);
  if (!devices) return tl::unexpected(devices.error());
  return assemble_rig(rig, *std::move(devices));
}

}  // namespace flytri::rig
