#include "hw/rig/open_rig.h"

#include "core/io/calibrations/calibration_file.h"
#include "hw/device/threaded_camera.h"
#include "hw/gpio/gpio_light_switch.h"
#include "hw/gpio/sequencer_lines.h"
#include "hw/rig/triggered_sensor.h"
#include "hw/stream/streamed_camera.h"

namespace flytri::rig {
namespace {

/// Null: the rig names none.
Result<std::shared_ptr<const calibration::Calibration>> calibration_of(const RigSettings& rig) {
  if (!rig.calibration) return nullptr;
  auto read = io::read_calibration(*rig.calibration);
  if (!read) return tl::unexpected(read.error());
  return std::make_shared<const calibration::Calibration>(*std::move(read));
}

/// What both sensors take from a rig.
template <typename Options>
Options options_of(const RigSettings& rig) {
  Options options;
  options.name = rig.name;
  options.flash_period_s = rig.flash_period_s;
  options.limits = rig.lights.limits;
  options.measurement_readout_s = rig.measurement.readout_s;
  if (rig.texture) options.texture_readout_s = rig.texture->readout_s;
  return options;
}

struct RigCameras {
  std::shared_ptr<device::Camera> measurement;
  std::shared_ptr<device::Camera> texture;
};

Result<RigCameras> make_cameras(const RigSettings& rig) {
  const CameraDrivers drivers = machine_drivers();
  const auto make_camera = [&](const RigCamera& camera) {
    return stream::StreamedCamera::create(drivers.of(camera.driver), camera.match, camera.settings);
  };
  RigCameras cameras;
  auto measurement = make_camera(rig.measurement);
  if (!measurement) return tl::unexpected(measurement.error());
  cameras.measurement = *std::move(measurement);
  if (!rig.texture) return cameras;
  auto texture = make_camera(*rig.texture);
  if (!texture) return tl::unexpected(texture.error());
  // On its own thread, so that restarting this camera does not cost frames of the other.
  cameras.texture = std::make_shared<device::ThreadedCamera>(*std::move(texture));
  return cameras;
}

Result<std::shared_ptr<Rig>> open_triggered(const RigSettings& rig) {
  auto calibration = calibration_of(rig);
  if (!calibration) return tl::unexpected(calibration.error());
  auto cameras = make_cameras(rig);
  if (!cameras) return tl::unexpected(cameras.error());
  auto options = options_of<TriggeredSensorOptions>(rig);
  options.vertical = rig.lights.vertical.offset.value_or(options.vertical);
  options.horizontal = rig.lights.horizontal.offset.value_or(options.horizontal);
  if (rig.lights.flash) options.flash = rig.lights.flash->offset.value_or(options.flash);
  return TriggeredSensor::create(
      {cameras->measurement, cameras->texture,
       [lights = rig.lights] { return gpio::open_sequencer(lights); }, device::machine_clock()},
      options, *std::move(calibration));
}

}  // namespace

Result<std::shared_ptr<RigSensor>> assemble_rig(const RigSettings& rig, RigDevices devices) {
  if (auto valid = rig.validate(); !valid) return tl::unexpected(valid.error());
  auto calibration = calibration_of(rig);
  if (!calibration) return tl::unexpected(calibration.error());
  const auto options = options_of<RigSensorOptions>(rig);
  return RigSensor::create(std::move(devices), options, *std::move(calibration));
}

Result<RigDevices> open_devices(const RigSettings& rig) {
  if (auto valid = rig.validate(); !valid) return tl::unexpected(valid.error());
  auto cameras = make_cameras(rig.free_running());
  if (!cameras) return tl::unexpected(cameras.error());
  auto lights = gpio::GpioLightSwitch::create(rig.lights);
  if (!lights) return tl::unexpected(lights.error());
  RigDevices devices;
  devices.clock = device::machine_clock();
  devices.measurement = std::move(cameras->measurement);
  devices.texture = std::move(cameras->texture);
  devices.lights = *std::move(lights);
  return devices;
}

Result<std::shared_ptr<Rig>> open_rig(const RigSettings& rig) {
  if (auto valid = rig.validate(); !valid) return tl::unexpected(valid.error());
  if (rig.is_triggered()) return open_triggered(rig);
  auto devices = open_devices(rig);
  if (!devices) return tl::unexpected(devices.error());
  return assemble_rig(rig, *std::move(devices));
}

}  // namespace flytri::rig
