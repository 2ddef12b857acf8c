#include "hw/simulated/optics/image_simulator.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/base/check_options.h"
#include "core/imaging/srgb.h"
#include "hw/simulated/optics/chip.h"
#include "hw/simulated/optics/grid_light.h"
#include "hw/simulated/optics/lens_blur.h"
#include "hw/simulated/optics/line_light.h"
#include "hw/simulated/optics/room_light.h"

namespace flytri::simulated {
namespace {

// Number of moments that are averaged over an exposure.
constexpr int kMotionSteps = 5;
// Rows of a rolling shutter that are exposed together. While 16 of 768 rows are read in 15 ms, a
// sensor of 10 mm/s moves by 3 µm.
constexpr int kBand_px = 16;
// Room light varies slowly: one ray per block with this side length.
constexpr int kAmbientBlock_px = 8;
// In real time, one ray per block with this side length; about the color resolution of a fine mesh.
constexpr int kTextureBlock_px = 5;

// Number of blocks of `step_px` x `step_px` pixels that cover an image.
cv::Size block_count(ImageSize size, int step_px) {
  return {(size.width_px + step_px - 1) / step_px, (size.height_px + step_px - 1) / step_px};
}

// Directions of the block centers, row by row.
std::vector<Vec3> block_directions(const CameraModel& camera, int step_px) {
  const cv::Size blocks = block_count(camera.size, step_px);
  std::vector<Vec3> directions;
  for (int j = 0; j < blocks.height; ++j)
    for (int i = 0; i < blocks.width; ++i) {
      const int u = std::min(i * step_px + step_px / 2, camera.size.width_px - 1);
      const int v = std::min(j * step_px + step_px / 2, camera.size.height_px - 1);
      directions.push_back(camera.direction({1.0 * u, 1.0 * v}));
    }
  return directions;
}

// Linear color, share of white by channel.
std::vector<cv::Vec3f> linear_colors(const TriangleMesh& mesh) {
  std::vector<cv::Vec3f> colors;
  for (const SurfacePoint& vertex : mesh.vertices) {
    cv::Vec3f color;
    for (int channel = 0; channel < 3; ++channel)
      color[channel] = static_cast<float>(to_linear(vertex.color[channel])) / 65535.0F;
    colors.push_back(color);
  }
  return colors;
}

}  // namespace

struct ImageSimulator::Parts {
  Parts(const TriangleMesh& mesh, const SensorModel& sensor_model,
        const ImageOptions& image_options)
      : sensor(sensor_model),
        options(image_options),
        scene(mesh),
        colors(linear_colors(mesh)),
        blur(LensBlur::around(sensor.volume, sensor.camera)),
        texture_blur(LensBlur::around(sensor.volume, sensor.texture_camera)),
        texture_step_px(options.tracing == Tracing::kGrid ? kTextureBlock_px : 1),
        texture_directions(block_directions(sensor.texture_camera, texture_step_px)),
        chip(sensor.chip) {
    if (options.tracing == Tracing::kEveryPixel) directions = sensor.camera.pixel_directions();
    for (const Pattern pattern : kPatterns) {
      if (options.tracing == Tracing::kGrid)
        grids.emplace_back(sensor, pattern);
      else
        lines.emplace_back(sensor, pattern);
    }
    for (const cv::Vec3f& color : colors) albedo.push_back((color[0] + color[1] + color[2]) / 3.0F);
  }

  LineExposure exposure_at(const SensorPath& path, double time_s) const;
  cv::Mat line_image(Pattern pattern, const SensorPath& path, double time_s) const;
  cv::Mat ambient_light(const Isometry& T_model_sensor) const;
  cv::Vec3f flash_light(const Isometry& T_model_sensor, const RayHit& hit) const;
  cv::Mat flash_image(const Isometry& T_model_sensor) const;

  SensorModel sensor;
  ImageOptions options;
  RayScene scene;
  std::vector<cv::Vec3f> colors;  // by vertex
  std::vector<float> albedo;      // by vertex, for the grey camera
  LensBlur blur, texture_blur;
  int texture_step_px;                   // side length of a block with one ray
  std::vector<Vec3> texture_directions;  // by block
  // Only one of the following groups is used, depending on Tracing.
  std::vector<Vec3> directions;  // by pixel
  std::vector<LineLight> lines;  // by Pattern
  std::vector<GridLight> grids;  // by Pattern
  Chip chip;
};

LineExposure ImageSimulator::Parts::exposure_at(const SensorPath& path, double time_s) const {
  const Isometry T_model_middle = path.T_model_sensor(time_s);
  std::vector<Isometry> T_then_middle;
  for (int i = 0; i < kMotionSteps; ++i) {
    const double moment = (i + 0.5) / kMotionSteps - 0.5;
    const double offset_s = options.motion ? moment * sensor.exposure_s : 0.0;
    T_then_middle.push_back(path.T_model_sensor(time_s + offset_s).inverse() * T_model_middle);
  }
  return {scene, albedo, directions, blur, T_model_middle, T_then_middle};
}

// Traced pixel by pixel. With a rolling shutter each band of rows is exposed at its own time.
cv::Mat ImageSimulator::Parts::line_image(Pattern pattern, const SensorPath& path,
                                          double time_s) const {
  const LineLight& light = lines[static_cast<std::size_t>(pattern)];
  if (options.readout_s == 0.0) return light.image(exposure_at(path, time_s));
  const int row_count = sensor.camera.size.height_px;
  cv::Mat image(row_count, sensor.camera.size.width_px, CV_32FC1);
  for (int begin = 0; begin < row_count; begin += kBand_px) {
    const cv::Range rows(begin, std::min(begin + kBand_px, row_count));
    const double share = 0.5 * (rows.start + rows.end) / row_count - 0.5;
    LineExposure exposure = exposure_at(path, time_s + share * options.readout_s);
    exposure.rows = rows;
    light.image(exposure).rowRange(rows).copyTo(image.rowRange(rows));
  }
  return image;
}

cv::Mat ImageSimulator::Parts::ambient_light(const Isometry& T_model_sensor) const {
  const ImageSize size = sensor.camera.size;
  const int columns = (size.width_px + kAmbientBlock_px - 1) / kAmbientBlock_px;
  const int rows = (size.height_px + kAmbientBlock_px - 1) / kAmbientBlock_px;
  std::vector<Ray> rays;
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const int u = std::min(i * kAmbientBlock_px + kAmbientBlock_px / 2, size.width_px - 1);
      const int v = std::min(j * kAmbientBlock_px + kAmbientBlock_px / 2, size.height_px - 1);
      const std::size_t pixel = static_cast<std::size_t>(v) * size.width_px + u;
      rays.push_back(
          {T_model_sensor * sensor.camera.center(), T_model_sensor.linear() * directions[pixel]});
    }
  std::vector<std::optional<RayHit>> hits(rays.size());
  scene.first_hits(rays, hits);
  cv::Mat coarse = cv::Mat::zeros(rows, columns, CV_32FC1);
  for (std::size_t i = 0; i < hits.size(); ++i) {
    if (!hits[i]) continue;
    const double facing = std::abs(hits[i]->normal.dot(rays[i].direction));
    coarse.at<float>(static_cast<int>(i)) = static_cast<float>(
        room_light(sensor.chip.ambient_level, albedo_at(scene.mesh(), albedo, *hits[i]), facing));
  }
  cv::Mat light;
  cv::resize(coarse, light, {size.width_px, size.height_px}, 0.0, 0.0, cv::INTER_LINEAR);
  return light;
}

// The flash surrounds the pupil of the texture camera, so the camera sees no shadows.
cv::Vec3f ImageSimulator::Parts::flash_light(const Isometry& T_model_sensor,
                                             const RayHit& hit) const {
  constexpr double kFlashWhiteLevel = 0.8;  // a white surface in the middle of the volume
  const Vec3 lamp = T_model_sensor * sensor.texture_camera.center();
  const Vec3 to_lamp = lamp - hit.point_mm;
  const double cosine = std::abs(smooth_normal_at(scene.mesh(), hit).dot(to_lamp)) / to_lamp.norm();
  const double falloff = sensor.texture_camera.center().squaredNorm() / to_lamp.squaredNorm();
  const Triangle& corners = scene.mesh().triangles[hit.triangle];
  cv::Vec3f color(0.0F, 0.0F, 0.0F);
  for (int k = 0; k < 3; ++k) color += static_cast<float>(hit.weights[k]) * colors[corners[k]];
  return color * static_cast<float>(kFlashWhiteLevel * cosine * falloff);
}

// The light at the middle of each block of pixels.
cv::Mat ImageSimulator::Parts::flash_image(const Isometry& T_model_sensor) const {
  const cv::Size blocks = block_count(sensor.texture_camera.size, texture_step_px);
  cv::Mat light(blocks, CV_32FC3, cv::Scalar::all(0.0));
  std::vector<Ray> rays(light.cols);
  std::vector<std::optional<RayHit>> hits(light.cols);
  const Vec3 origin = T_model_sensor * sensor.texture_camera.center();
  for (int j = 0; j < light.rows; ++j) {
    const Vec3* row = &texture_directions[static_cast<std::size_t>(j) * light.cols];
    for (int i = 0; i < light.cols; ++i) rays[i] = {origin, T_model_sensor.linear() * row[i]};
    scene.first_hits(rays, hits);
    for (int i = 0; i < light.cols; ++i)
      if (hits[i]) light.at<cv::Vec3f>(j, i) = flash_light(T_model_sensor, *hits[i]);
  }
  return light;
}

Result<void> ImageOptions::validate() const {
  return OptionCheck("ImageOptions")
      .must("bits", bits, bits == 8 || bits == 16, "8 or 16")
      .in_range("exposures", exposures, 1, 1000)
      .must("readout_s", readout_s,
            readout_s >= 0.0 && (readout_s == 0.0 || tracing == Tracing::kEveryPixel),
            "0 or more, and 0 with Tracing::kGrid")
      .result();
}

Result<ImageSimulator> ImageSimulator::create(const TriangleMesh& mesh, const SensorModel& sensor,
                                              const ImageOptions& options) {
  if (auto valid = sensor.validate(); !valid) return tl::unexpected(valid.error());
  if (auto valid = options.validate(); !valid) return tl::unexpected(valid.error());
  if (mesh.triangles.empty())
    return fail(ErrorCode::kInsufficient, "the mesh to be scanned has no triangles");
  return ImageSimulator(std::make_shared<const Parts>(mesh, sensor, options));
}

cv::Mat ImageSimulator::measurement_image(Pattern pattern, const SensorPath& path, double time_s,
                                          std::uint64_t stream) const {
  const ImageOptions& options = parts_->options;
  const bool grid = options.tracing == Tracing::kGrid;
  const Chip::Light light = grid ? parts_->grids[static_cast<std::size_t>(pattern)].light(
                                       parts_->exposure_at(path, time_s))
                                 : Chip::Light{parts_->line_image(pattern, path, time_s),
                                               parts_->ambient_light(path.T_model_sensor(time_s))};
  return parts_->chip.read_out(light, {.bits = options.bits,
                                       .exposures = options.exposures,
                                       .noise = options.noise,
                                       .seed = options.seed,
                                       .stream = stream,
                                       .stored_noise = grid && options.exposures == 1});
}

cv::Mat ImageSimulator::texture_image(const Isometry& T_model_sensor, std::uint64_t stream) const {
  const ImageOptions& options = parts_->options;
  const CameraModel& camera = parts_->sensor.texture_camera;
  const bool grid = options.tracing == Tracing::kGrid;
  cv::Mat light = parts_->flash_image(T_model_sensor);
  if (grid) {
    // The interpolation blurs about as much as the lens would.
    cv::resize(light, light, {}, kTextureBlock_px, kTextureBlock_px, cv::INTER_LINEAR);
    light = light(cv::Rect(0, 0, camera.size.width_px, camera.size.height_px));
  } else {
    // The aperture is small, so the blur of the volume's middle is nearly right everywhere.
    cv::filter2D(light, light, -1, parts_->texture_blur.kernel(camera.center().norm()));
  }
  return parts_->chip.read_out_color(
      light,
      {.noise = options.noise, .seed = options.seed, .stream = stream, .stored_noise = grid});
}

const SensorModel& ImageSimulator::sensor() const { return parts_->sensor; }
const RayScene& ImageSimulator::scene() const { return parts_->scene; }

}  // namespace flytri::simulated
