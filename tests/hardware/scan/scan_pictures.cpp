#include "tests/hardware/scan/scan_pictures.h"

#include <fmt/format.h>

#include "assets/sample_jaw/sample_jaw.h"
#include "core/io/files/file_bytes.h"
#include "tests/hardware/usb/jpeg.h"

namespace flytri::scan {

Result<void> write_picture(const std::filesystem::path& file, const cv::Mat& image) {
  const std::size_t bytes = image.total() * image.elemSize();
  if (image.channels() == 1)
    return io::write_file(file, {reinterpret_cast<const char*>(image.data), bytes});
  const usb::Bytes jpeg = usb::encode_jpeg(
      {image.data, bytes},
      {static_cast<std::uint32_t>(image.cols), static_cast<std::uint32_t>(image.rows)});
  return io::write_file(file, {reinterpret_cast<const char*>(jpeg.data()), jpeg.size()});
}

Result<ScanPictures> ScanPictures::create(const ScanOptions& options, const Workers& workers) {
  auto mesh = sample_jaw::make_sample_jaw({}, workers);
  if (!mesh) return tl::unexpected(mesh.error());
  std::vector<double> times_s;
  // Before the start of the path, the sensor rests.
  for (int i = 0; i < options.resting + options.moving; ++i)
    times_s.push_back((i - options.resting) * options.sensor.frame_period_s);
  return create(*std::move(mesh), options.sensor, options.path, times_s);
}

Result<ScanPictures> ScanPictures::create(TriangleMesh mesh, const simulated::SensorModel& sensor,
                                          const simulated::PathOptions& path,
                                          const std::vector<double>& times_s) {
  auto scene =
      simulated::LitScene::create(mesh, sensor, path, {.tracing = simulated::Tracing::kGrid});
  if (!scene) return tl::unexpected(scene.error());
  std::vector<Moment> moments;
  for (const double time_s : times_s)
    moments.push_back({time_s, scene->path().T_model_sensor(time_s)});
  return ScanPictures(std::move(mesh), *std::move(scene), std::move(moments));
}

cv::Mat ScanPictures::picture(std::size_t number, FrameKind kind) const {
  const double time_s = moments_.at(number).time_s;
  if (kind == FrameKind::kTexture) return scene_.texture_image(device::Light::kFlash, time_s);
  return scene_.measurement_image(
      kind == FrameKind::kVertical ? device::Light::kVertical : device::Light::kHorizontal, time_s);
}

Result<void> ScanPictures::write(const std::filesystem::path& folder, std::size_t number) const {
  for (const device::Light light :
       {device::Light::kVertical, device::Light::kHorizontal, device::Light::kFlash}) {
    const cv::Mat image = scene_.measurement_image(light, moments_.at(number).time_s);
    const auto file = folder / fmt::format("{}_{}.grey", number, to_string(light));
    if (auto written = write_picture(file, image); !written) return written;
  }
  return write_picture(folder / fmt::format("{}_flash.jpg", number),
                       picture(number, FrameKind::kTexture));
}

Result<void> ScanPictures::write(const std::filesystem::path& folder,
                                 const Workers& workers) const {
  if (auto made = io::create_folder(folder); !made) return made;
  std::vector<Result<void>> written(moments_.size());
  workers.for_each(moments_.size(),
                   [&](std::size_t number) { written[number] = write(folder, number); });
  for (const Result<void>& each : written)
    if (!each) return each;
  return {};
}

}  // namespace flytri::scan
