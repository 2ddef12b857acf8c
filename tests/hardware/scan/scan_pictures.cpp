#include "tests/hardware/scan/scan_pictures.h"

#include <fmt/format.h>

#include "assets/sample_jaw/sample_jaw.h"
#include "core/interchange/file_bytes.h"

namespace flytri::scan {
namespace {

std::vector<Moment> moments_of(const ScanOptions& options, const SensorPath& path) {
  std::vector<Moment> moments;
  for (int i = 0; i < options.resting + options.moving; ++i) {
    // Before its start the path rests.
    const double time_s = (i - options.resting) * options.sensor.frame_period_s;
    moments.push_back({time_s, path.T_model_sensor(time_s)});
  }
  return moments;
}

}  // namespace

Result<ScanPictures> ScanPictures::create(const ScanOptions& options, const Workers& workers) {
  auto mesh = sample_jaw::make_sample_jaw({}, workers);
  if (!mesh) return tl::unexpected(mesh.error());
  auto scene = LitScene::create(*mesh, options.sensor, options.path, {.tracing = Tracing::kGrid});
  if (!scene) return tl::unexpected(scene.error());
  std::vector<Moment> moments = moments_of(options, scene->path());
  return ScanPictures(*std::move(mesh), *std::move(scene), std::move(moments));
}

cv::Mat ScanPictures::picture(std::size_t number, Light light) const {
  return scene_.measurement_image(light, moments_.at(number).time_s);
}

Result<void> ScanPictures::write(const std::filesystem::path& folder,
                                 const Workers& workers) const {
  if (auto made = create_folder(folder); !made) return made;
  std::vector<Result<void>> written(moments_.size());
  workers.for_each(moments_.size(), [&](std::size_t number) {
    for (const Light light : {Light::kVertical, Light::kHorizontal}) {
      const cv::Mat image = picture(number, light);
      const std::string_view bytes(reinterpret_cast<const char*>(image.data), image.total());
      const auto file = folder / fmt::format("{}_{}.grey", number, to_string(light));
      if (written[number]) written[number] = write_file(file, bytes);
    }
  });
  for (const Result<void>& each : written)
    if (!each) return each;
  return {};
}

}  // namespace flytri::scan
