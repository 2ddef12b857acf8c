#include "core/texture/observe.h"

#include <cmath>
#include <limits>

#include "core/base/check_options.h"
#include "core/texture/srgb.h"

namespace flytri::texture {
namespace {

/// Points tested together: neighbors in the list are usually neighbors in space.
constexpr std::size_t kBlock = 256;

/// Projection of a point into a texture frame.
struct Projection {
  float u_px = 0.0F, v_px = 0.0F;
  float depth_mm = std::numeric_limits<float>::infinity();  ///< infinite: outside the image
  bool facing = false;
};

/// Vector along the texture camera's ray of sight: U and V do not change along it. Its length is
/// the number of pixels per square millimeter perpendicular to the ray.
Vec3 pixels_along_ray(const calibration::Calibration& calibration, const Vec3& p_sensor) {
  return calibration.texture_u_px.gradient(p_sensor).cross(
      calibration.texture_v_px.gradient(p_sensor));
}

/// Unit vector of the ray of sight.
Vec3 ray_of_sight(const calibration::Calibration& calibration, const Vec3& p_sensor) {
  const Vec3 ray = pixels_along_ray(calibration, p_sensor).normalized();
  return ray.z() < 0.0 ? Vec3(-ray) : ray;
}

/// The z-buffer of one frame: depth of the closest point in each cell.
class DepthBuffer {
 public:
  DepthBuffer(ImageSize size, int cell_px)
      : cell_px_(static_cast<float>(cell_px)),
        width_(size.width_px / cell_px + 1),
        depths_mm_(static_cast<std::size_t>(width_ * (size.height_px / cell_px + 1)),
                   std::numeric_limits<float>::infinity()) {}

  void add(const Projection& p) {
    float& depth_mm = depths_mm_[cell_of(p)];
    depth_mm = std::min(depth_mm, p.depth_mm);
  }
  [[nodiscard]] float closest_mm(const Projection& p) const { return depths_mm_[cell_of(p)]; }

 private:
  [[nodiscard]] std::size_t cell_of(const Projection& p) const {
    return static_cast<std::size_t>(p.v_px / cell_px_) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(p.u_px / cell_px_);
  }
  float cell_px_;
  int width_;
  std::vector<float> depths_mm_;
};

/// Bilinear interpolation of sRGB values. The position must be inside the image.
Vec3f sample(const cv::Mat& image, float u_px, float v_px) {
  const int u = std::min(static_cast<int>(u_px), image.cols - 2);
  const int v = std::min(static_cast<int>(v_px), image.rows - 2);
  const float a = u_px - static_cast<float>(u);
  const float b = v_px - static_cast<float>(v);
  Vec3f sum = Vec3f::Zero();
  for (const int dv : {0, 1}) {
    for (const int du : {0, 1}) {
      const auto& pixel = image.at<cv::Vec3b>(v + dv, u + du);
      const float weight = (du == 1 ? a : 1.0F - a) * (dv == 1 ? b : 1.0F - b);
      sum += weight * Vec3f(pixel[0], pixel[1], pixel[2]);
    }
  }
  return sum;
}

double margin_mm(const calibration::Calibration& calibration, const TextureOptions& options) {
  return options.volume_margin_share * calibration.volume.size_mm.maxCoeff();
}

/// False if the bounding sphere of the points is outside the measurement volume.
bool may_reach_volume(std::span<const SurfacePoint> points, const Isometry& T_sensor_world,
                      const calibration::Calibration& calibration, const TextureOptions& options) {
  Vec3f low = points.front().position_mm;
  Vec3f high = low;
  for (const SurfacePoint& point : points) {
    low = low.cwiseMin(point.position_mm);
    high = high.cwiseMax(point.position_mm);
  }
  const double radius_mm = 0.5 * static_cast<double>((high - low).norm());
  const Vec3 middle_sensor = T_sensor_world * (0.5F * (low + high)).cast<double>();
  return calibration.volume.contains(middle_sensor, margin_mm(calibration, options) + radius_mm);
}

Projection project(const SurfacePoint& point, const Isometry& T_sensor_world,
                   const calibration::Calibration& calibration, const TextureOptions& options) {
  const Vec3 p_sensor = T_sensor_world * point.position_mm.cast<double>();
  Projection projection;
  if (!calibration.volume.contains(p_sensor, margin_mm(calibration, options))) return projection;
  const Pixel pixel = calibration.project_to_texture(p_sensor);
  const ImageSize size = calibration.texture_size;
  if (!(pixel.u_px >= 0.0 && pixel.v_px >= 0.0 && pixel.u_px <= size.width_px - 1 &&
        pixel.v_px <= size.height_px - 1)) {
    return projection;
  }
  const Vec3 ray = ray_of_sight(calibration, p_sensor);
  const Vec3 normal = T_sensor_world.linear() * point.normal.cast<double>();
  projection.u_px = static_cast<float>(pixel.u_px);
  projection.v_px = static_cast<float>(pixel.v_px);
  projection.depth_mm = static_cast<float>(ray.dot(p_sensor));
  projection.facing = -normal.dot(ray) >= options.min_facing_cosine;
  return projection;
}

}  // namespace

void ObservedColor::add(const Vec3f& light) {
  const float intensity = light.mean();
  if (intensity <= 0.0F) return;
  chromaticity_ += light / intensity;
  highest_intensity_ = std::max(highest_intensity_, intensity);
  ++count_;
}

Rgb ObservedColor::color() const {
  const Vec3f light = highest_intensity_ / static_cast<float>(count_) * chromaticity_;
  Rgb color;
  for (int c = 0; c < 3; ++c) color[c] = srgb_from_linear(light[c]);
  return color;
}

double pixels_per_mm2(const SurfacePoint& point, const Isometry& T_sensor_world,
                      const calibration::Calibration& calibration, const TextureOptions& options) {
  if (!project(point, T_sensor_world, calibration, options).facing) return 0.0;
  const Vec3 p_sensor = T_sensor_world * point.position_mm.cast<double>();
  const Vec3 normal = T_sensor_world.linear() * point.normal.cast<double>();
  return std::abs(pixels_along_ray(calibration, p_sensor).dot(normal));
}

Result<void> check_texture_image(const cv::Mat& image,
                                 const calibration::Calibration& calibration) {
  const ImageSize size{image.cols, image.rows};
  if (image.type() != CV_8UC3) {
    return fail(ErrorCode::kBadFormat, "a texture frame must be an 8-bit RGB image; record again");
  }
  if (size == calibration.texture_size) return {};
  return fail(ErrorCode::kInconsistent,
              "a texture frame has {} x {} px, but the calibration is for {} x {} px; use the "
              "calibration of this sensor",
              size.width_px, size.height_px, calibration.texture_size.width_px,
              calibration.texture_size.height_px);
}

Result<void> observe_points(std::span<const SurfacePoint> points, std::span<ObservedColor> colors,
                            const TextureFrame& frame, const calibration::Calibration& calibration,
                            const TextureOptions& options, const Workers& workers) {
  if (auto fits = check_texture_image(frame.image, calibration); !fits) return fits;
  const Isometry T_sensor_world = frame.T_world_sensor.inverse();
  // By block of points; empty if the frame sees none of them.
  std::vector<std::vector<Projection>> blocks((points.size() + kBlock - 1) / kBlock);
  workers.for_each(blocks.size(), [&](std::size_t b) {
    const auto block = points.subspan(b * kBlock, std::min(kBlock, points.size() - b * kBlock));
    if (!may_reach_volume(block, T_sensor_world, calibration, options)) return;
    blocks[b].reserve(block.size());
    for (const SurfacePoint& point : block) {
      blocks[b].push_back(project(point, T_sensor_world, calibration, options));
    }
  });
  DepthBuffer buffer(calibration.texture_size, options.depth_cell_px);
  for (const auto& block : blocks) {
    for (const Projection& projection : block) {
      if (std::isfinite(projection.depth_mm)) buffer.add(projection);
    }
  }
  const auto tolerance_mm =
      static_cast<float>(options.depth_tolerance_share * calibration.volume.size_mm.z());
  workers.for_each(blocks.size(), [&](std::size_t b) {
    for (std::size_t i = 0; i < blocks[b].size(); ++i) {
      const Projection& p = blocks[b][i];
      if (!p.facing || !std::isfinite(p.depth_mm)) continue;
      if (p.depth_mm > buffer.closest_mm(p) + tolerance_mm) continue;
      const Vec3f srgb = sample(frame.image, p.u_px, p.v_px);
      if (srgb.maxCoeff() > static_cast<float>(options.max_channel)) continue;
      colors[b * kBlock + i].add(
          {linear_from_srgb(srgb.x()), linear_from_srgb(srgb.y()), linear_from_srgb(srgb.z())});
    }
  });
  return {};
}

Result<void> TextureOptions::validate() const {
  return OptionCheck("TextureOptions")
      .in_range("min_facing_cosine", min_facing_cosine, 0.0, 1.0)
      .at_least("depth_cell_px", depth_cell_px, 1)
      .positive("depth_tolerance_share", depth_tolerance_share)
      .not_negative("volume_margin_share", volume_margin_share)
      .in_range("max_channel", max_channel, 1, 255)
      .not_negative("extend_share", extend_share)
      .result();
}

}  // namespace flytri::texture
