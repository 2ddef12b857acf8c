#include "hw/simulated/devices/lit_scene.h"

#include <cmath>

namespace flytri::simulated {
namespace {

/// Simulates projectors that are off: lines far too faint for one gray value.
constexpr double kNoLines = 1e-9;
/// Brightness of a white surface under the flash in the measurement camera, share of full scale.
constexpr double kFlashLevel = 0.5;

/// The random stream of an image's noise.
std::uint64_t stream_of(device::Light light, double time_s) {
  return static_cast<std::uint64_t>(std::llround(time_s * 1e6)) * 4 +
         static_cast<std::uint64_t>(light);
}

}  // namespace

Result<LitScene> LitScene::create(const TriangleMesh& mesh, const SensorModel& sensor,
                                  const PathOptions& path, const ImageOptions& options) {
  SensorModel unlit = sensor;
  unlit.chip.line_level = kNoLines;
  SensorModel flashed = unlit;
  flashed.chip.ambient_level = kFlashLevel;
  auto lines = ImageSimulator::create(mesh, sensor, options);
  if (!lines) return tl::unexpected(lines.error());
  auto dark = ImageSimulator::create(mesh, unlit, options);
  if (!dark) return tl::unexpected(dark.error());
  auto flash = ImageSimulator::create(mesh, flashed, options);
  if (!flash) return tl::unexpected(flash.error());
  auto planned = plan_path(lines->scene(), sensor, path);
  if (!planned) return tl::unexpected(planned.error());
  return LitScene(*std::move(lines), *std::move(dark), *std::move(flash), *std::move(planned));
}

cv::Mat LitScene::measurement_image(device::Light light, double time_s) const {
  const std::uint64_t stream = stream_of(light, time_s);
  const Pattern pattern =
      light == device::Light::kHorizontal ? Pattern::kHorizontal : Pattern::kVertical;
  const ImageSimulator& simulator = light == device::Light::kDark    ? dark_
                                    : light == device::Light::kFlash ? flash_
                                                                     : lines_;
  return simulator.measurement_image(pattern, path_, time_s, stream);
}

cv::Mat LitScene::texture_image(device::Light light, double time_s) const {
  const ImageSize size = lines_.sensor().texture_camera.size;
  if (light != device::Light::kFlash) return cv::Mat::zeros(size.height_px, size.width_px, CV_8UC3);
  return lines_.texture_image(path_.T_model_sensor(time_s), stream_of(light, time_s));
}

}  // namespace flytri::simulated
