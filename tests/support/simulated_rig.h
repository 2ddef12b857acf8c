/// @file  A rig with simulated devices and a manual clock.
#pragma once

#include <memory>

#include "hw/rig/rig_sensor.h"
#include "hw/simulated/devices/simulated_camera.h"
#include "hw/simulated/devices/simulated_lights.h"
#include "tests/support/manual_clock.h"

namespace flytri::testing {

/// Scene of the measurement camera: a small image of lines or of a bright area, or dark, depending
/// on the light.
[[nodiscard]] inline cv::Mat striped_scene(device::Light light, double /*time_s*/) {
  cv::Mat image(192, 256, CV_8UC1, cv::Scalar(8));
  if (light == device::Light::kFlash) image(cv::Rect(30, 20, 180, 150)).setTo(140);
  for (int at_px = 12; light == device::Light::kVertical && at_px < image.cols; at_px += 32)
    image.colRange(at_px, at_px + 4).setTo(120);
  for (int at_px = 12; light == device::Light::kHorizontal && at_px < image.rows; at_px += 32)
    image.rowRange(at_px, at_px + 4).setTo(120);
  return image;
}

/// Scene of the texture camera: the same in color.
[[nodiscard]] inline cv::Mat colored_scene(device::Light light, double time_s) {
  const cv::Mat gray = striped_scene(light, time_s);
  cv::Mat color;
  cv::merge(std::vector<cv::Mat>{gray, gray, gray}, color);
  return color;
}

/// The devices, accessible to tests, and the sensor that uses them.
struct SimulatedRig {
  ManualClock clock;
  std::shared_ptr<simulated::SimulatedLights> lights;
  std::shared_ptr<simulated::SimulatedCamera> measurement, texture;
  std::shared_ptr<rig::RigSensor> sensor;
};

struct SimulatedRigOptions {
  simulated::SimulatedLightsOptions lights;
  simulated::SimulatedCameraOptions measurement;
  simulated::SimulatedCameraOptions texture;
  simulated::SimulatedCamera::Scene measurement_scene = striped_scene;
  simulated::SimulatedCamera::Scene texture_scene = colored_scene;
  bool has_texture = true;
  std::shared_ptr<const calibration::Calibration> calibration;
  rig::RigSensorOptions sensor;
};

[[nodiscard]] inline SimulatedRig make_simulated_rig(const SimulatedRigOptions& options) {
  SimulatedRig rig;
  rig.lights = std::make_shared<simulated::SimulatedLights>(options.lights, rig.clock.clock());
  rig.measurement = std::make_shared<simulated::SimulatedCamera>(
      options.measurement, options.measurement_scene, rig.lights, rig.clock.clock());
  if (options.has_texture)
    rig.texture = std::make_shared<simulated::SimulatedCamera>(
        options.texture, options.texture_scene, rig.lights, rig.clock.clock());
  rig.sensor = rig::RigSensor::create({rig.measurement, rig.texture, rig.lights, rig.clock.clock()},
                                      options.sensor, options.calibration)
                   .value();
  return rig;
}

}  // namespace flytri::testing
