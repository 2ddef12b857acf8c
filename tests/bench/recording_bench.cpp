/// @file  Benchmarks of recording: writes frames of two cameras to disk like the recorder's thread.
#include <benchmark/benchmark.h>

#include <opencv2/imgcodecs.hpp>

#include "assets/sample_jaw/sample_jaw.h"
#include "core/io/files/png.h"
#include "core/io/recordings/recording.h"
#include "hw/simulated/devices/lit_scene.h"
#include "hw/sync/frame_labeler.h"
#include "tests/support/temporary_folder.h"

namespace flytri {
namespace {

/// An image of the jaw under a light, 1024x768: grey lines, or in color under the flash.
cv::Mat image_of(device::Light light, bool is_color) {
  const TriangleMesh jaw = sample_jaw::make_sample_jaw({}, Workers()).value();
  simulated::SensorModel sensor = simulated::intraoral_sensor();
  sensor.texture_camera.size = sensor.camera.size;
  const simulated::LitScene scene =
      simulated::LitScene::create(jaw, sensor, {}, {.tracing = simulated::Tracing::kGrid}).value();
  return is_color ? scene.texture_image(light, 5.0) : scene.measurement_image(light, 5.0);
}

/// Reports pixel bytes per second. At 30 Hz, a grey camera of this size delivers 24 MB/s and a
/// color camera 71 MB/s.
void record(benchmark::State& state, FrameKind kind) {
  const bool is_color = kind == FrameKind::kTexture;
  const cv::Mat image =
      image_of(is_color ? device::Light::kFlash : device::Light::kVertical, is_color);
  const TemporaryFolder folder;
  auto writer = io::RecordingWriter::create(folder / "scan").value();
  double time_s = 0.0;
  for (auto _ : state) {
    time_s += 1.0;
    if (!writer.append({FrameIndex(), kind, time_s, image})) state.SkipWithError("disk is full");
  }
  state.SetBytesProcessed(
      static_cast<std::int64_t>(state.iterations() * image.total() * image.elemSize()));
}
BENCHMARK_CAPTURE(record, grey, FrameKind::kVertical)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(record, color, FrameKind::kTexture)->Unit(benchmark::kMillisecond);

std::string png_of_camera() {
  return io::encode_camera_png(image_of(device::Light::kVertical, false)).value();
}

void decode_png(benchmark::State& state) {
  const std::string bytes = png_of_camera();
  for (auto _ : state) benchmark::DoNotOptimize(io::decode_png(bytes, "frame.png"));
}
BENCHMARK(decode_png)->Unit(benchmark::kMillisecond);

/// The peer.
void decode_png_by_opencv(benchmark::State& state) {
  const std::string bytes = png_of_camera();
  const std::vector<std::uint8_t> buffer(bytes.begin(), bytes.end());
  for (auto _ : state) benchmark::DoNotOptimize(cv::imdecode(buffer, cv::IMREAD_UNCHANGED));
}
BENCHMARK(decode_png_by_opencv)->Unit(benchmark::kMillisecond);

/// Time to label a frame in the capture thread.
void label_frame(benchmark::State& state) {
  const cv::Mat image = image_of(device::Light::kVertical, false);
  auto labeler = sync::FrameLabeler::create({}).value();
  double stamp_s = 0.0;
  for (auto _ : state) {
    stamp_s += 1.0 / 30.0;
    benchmark::DoNotOptimize(labeler.label(image, stamp_s));
  }
}
BENCHMARK(label_frame)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace flytri
