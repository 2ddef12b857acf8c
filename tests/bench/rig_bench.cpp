/// @file  Benchmarks of a rig in real time: processor time to read, label and record its cameras,
/// and the delay of a frame from the camera to the caller.
#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

#include "assets/sample_jaw/sample_jaw.h"
#include "hw/device/threaded_camera.h"
#include "hw/recording/recorder_sensor.h"
#include "hw/rig/rig_sensor.h"
#include "hw/simulated/devices/lit_scene.h"
#include "hw/simulated/devices/simulated_camera.h"
#include "tests/support/temporary_folder.h"

namespace flytri {
namespace {

constexpr double kDuration_s = 12.0;
/// Time until the lights are synchronized.
constexpr double kLearning_s = 2.0;
/// Delay of the simulated camera from the middle of an exposure to the frame.
constexpr double kCamera_s = 0.04;

/// An image of the jaw under each light, 1024x768.
std::array<cv::Mat, sync::kLightCount> images_of(bool is_color) {
  const TriangleMesh jaw = sample_jaw::make_sample_jaw({}, Workers()).value();
  simulated::SensorModel sensor = simulated::intraoral_sensor();
  sensor.texture_camera.size = sensor.camera.size;
  const simulated::LitScene scene =
      simulated::LitScene::create(jaw, sensor, {}, {.tracing = simulated::Tracing::kGrid}).value();
  std::array<cv::Mat, sync::kLightCount> images;
  for (const device::Light light : {device::Light::kDark, device::Light::kVertical,
                                    device::Light::kHorizontal, device::Light::kFlash})
    images[sync::at(light)] =
        is_color ? scene.texture_image(light, 5.0) : scene.measurement_image(light, 5.0);
  return images;
}

/// Delivers precomputed images, so that frames cost no more than with a real driver.
class ReadyCamera final : public device::Camera {
 public:
  ReadyCamera(std::array<cv::Mat, sync::kLightCount> images, device::Channels channels,
              std::shared_ptr<simulated::SimulatedLights> lights)
      : images_(std::move(images)), lights_(std::move(lights)), clock_(device::machine_clock()) {
    settings_.channels = channels;
    settings_.exposure_s = 0.01;
  }
  Result<void> start() override {
    start_s_ = clock_.now_s();
    status_.state = device::CameraState::kRunning;
    return {};
  }
  void stop() override { status_.state = device::CameraState::kIdle; }
  Result<std::optional<device::CameraFrame>> next(double timeout_s) override {
    const double middle_s = start_s_ + static_cast<double>(sequence_) / settings_.rate_hz;
    clock_.sleep_s(std::min(middle_s + kCamera_s - clock_.now_s(), timeout_s));
    if (clock_.now_s() < middle_s + kCamera_s) return std::nullopt;
    const double half_s = 0.5 * *settings_.exposure_s;
    const sync::LightTimes times = lights_->truth(middle_s - half_s, middle_s + half_s);
    const auto most = std::max_element(times.lit_s.begin(), times.lit_s.end());
    ++status_.delivered;
    return device::CameraFrame{
        images_[static_cast<std::size_t>(most - times.lit_s.begin())].clone(), middle_s + kCamera_s,
        device::StampMeaning::kEndOfReadout, sequence_++, false};
  }
  [[nodiscard]] device::CameraStatus status() const override { return status_; }
  [[nodiscard]] device::CameraSettings requested() const override { return settings_; }
  [[nodiscard]] device::CameraSettings read_back() const override { return settings_; }
  [[nodiscard]] std::string name() const override { return "ready"; }

 private:
  const std::array<cv::Mat, sync::kLightCount> images_;
  const std::shared_ptr<simulated::SimulatedLights> lights_;
  const device::Clock clock_;
  device::CameraSettings settings_;
  device::CameraStatus status_;
  double start_s_ = 0.0;
  std::int64_t sequence_ = 0;
};

double processor_s() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

double at_share(std::vector<double>& values, double share) {
  if (values.empty()) return 0.0;
  const auto place =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

std::shared_ptr<rig::RigSensor> make_rig(bool has_texture) {
  const auto lights = std::make_shared<simulated::SimulatedLights>(
      simulated::SimulatedLightsOptions{}, device::machine_clock());
  rig::RigDevices devices;
  devices.measurement =
      std::make_shared<ReadyCamera>(images_of(false), device::Channels::kGrey, lights);
  if (has_texture)
    devices.texture = std::make_shared<device::ThreadedCamera>(
        std::make_unique<ReadyCamera>(images_of(true), device::Channels::kRgb, lights));
  devices.lights = lights;
  devices.clock = device::machine_clock();
  return rig::RigSensor::create(devices, {}, nullptr).value();
}

/// @param sensor  must be started
/// @return  delay of each frame from the camera to the caller, s
std::vector<double> read_frames(device::Sensor& sensor, double start_s) {
  const device::Clock clock = device::machine_clock();
  std::vector<double> latencies_s;
  while (clock.now_s() < start_s + kDuration_s) {
    const auto frame = sensor.next(0.05).value();
    if (!frame || clock.now_s() < start_s + kLearning_s) continue;
    latencies_s.push_back(clock.now_s() - (start_s + frame->time_s + kCamera_s));
  }
  return latencies_s;
}

/// One or two cameras at 30 Hz for 12 s; includes the cost of passing on the images.
void rig(benchmark::State& state, bool is_recorded) {
  for (auto _ : state) {
    const TemporaryFolder folder;
    std::shared_ptr<device::Sensor> sensor = make_rig(state.range(0) == 2);
    std::shared_ptr<recording::RecorderSensor> recorder;
    if (is_recorded)
      sensor = recorder = recording::RecorderSensor::create(sensor, folder / "scan").value();
    if (!sensor->start()) return state.SkipWithError("does not start");
    const double start_s = device::machine_clock().now_s();
    const double before_s = processor_s();
    std::atomic<bool> is_over = false;
    std::thread writer([&] {
      while (!is_over && recorder) recorder->work_in_background(0.05);
    });
    std::vector<double> latencies_s = read_frames(*sensor, start_s);
    is_over = true;
    writer.join();
    state.counters["cores"] = (processor_s() - before_s) / kDuration_s;
    sensor->stop();
    state.counters["frames_per_s"] =
        static_cast<double>(latencies_s.size()) / (kDuration_s - kLearning_s);
    state.counters["median_ms"] = 1e3 * at_share(latencies_s, 0.5);
    state.counters["95_percent_ms"] = 1e3 * at_share(latencies_s, 0.95);
    if (!recorder) continue;
    state.counters["written"] = static_cast<double>(recorder->recorder_status().written);
    state.counters["lost"] = static_cast<double>(recorder->recorder_status().lost);
  }
}
BENCHMARK_CAPTURE(rig, read, false)->Arg(1)->Arg(2)->Iterations(1)->UseRealTime();
BENCHMARK_CAPTURE(rig, recorded, true)->Arg(1)->Arg(2)->Iterations(1)->UseRealTime();

}  // namespace
}  // namespace flytri
