/// @file  Benchmarks of sources of frames: images of the virtual sensor, recording and replay.
#include <benchmark/benchmark.h>

#include "assets/sample_jaw/sample_jaw.h"
#include "core/io/files/png.h"
#include "hw/simulated/optics/image_simulator.h"

namespace flytri {
namespace {

/// The sample jaw, a sensor over it and the path of the hand.
struct LiveScene {
  simulated::ImageSimulator simulator;
  simulated::SensorPath path;
};

LiveScene make_scene(simulated::Tracing tracing) {
  const TriangleMesh jaw = sample_jaw::make_sample_jaw({}, Workers()).value();
  simulated::ImageSimulator simulator =
      simulated::ImageSimulator::create(jaw, simulated::intraoral_sensor(), {.tracing = tracing})
          .value();
  simulated::PathOptions options;
  options.kind = simulated::PathKind::kQuadrant;
  simulated::SensorPath path =
      simulated::plan_path(simulator.scene(), simulator.sensor(), options).value();
  return {std::move(simulator), std::move(path)};
}

/// Positions all over the path, so that easy and hard images occur as in a scan.
double place_s(int i) { return 0.37 * (i % 90); }

void live_measurement_image(benchmark::State& state, simulated::Tracing tracing) {
  const LiveScene scene = make_scene(tracing);
  int i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        scene.simulator.measurement_image(kPatterns[i % 2], scene.path, place_s(i), i));
    ++i;
  }
}
BENCHMARK_CAPTURE(live_measurement_image, every_pixel, simulated::Tracing::kEveryPixel)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(live_measurement_image, grid, simulated::Tracing::kGrid)
    ->Unit(benchmark::kMillisecond);

void live_texture_image(benchmark::State& state, simulated::Tracing tracing) {
  const LiveScene scene = make_scene(tracing);
  int i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        scene.simulator.texture_image(scene.path.T_model_sensor(place_s(i)), i));
    ++i;
  }
}
BENCHMARK_CAPTURE(live_texture_image, every_pixel, simulated::Tracing::kEveryPixel)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(live_texture_image, grid, simulated::Tracing::kGrid)
    ->Unit(benchmark::kMillisecond);

cv::Mat frame_image() {
  const LiveScene scene = make_scene(simulated::Tracing::kGrid);
  return scene.simulator.measurement_image(Pattern::kVertical, scene.path, 5.0, 0);
}

void encode_frame(benchmark::State& state) {
  const cv::Mat image = frame_image();
  for (auto _ : state) benchmark::DoNotOptimize(io::encode_camera_png(image).value());
}
BENCHMARK(encode_frame)->Unit(benchmark::kMillisecond);

void decode_frame(benchmark::State& state) {
  const std::string bytes = io::encode_camera_png(frame_image()).value();
  for (auto _ : state) benchmark::DoNotOptimize(io::decode_png(bytes, "frame").value());
}
BENCHMARK(decode_frame)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace flytri
