#include "core/texture/color_points.h"

#include <array>
#include <cmath>
#include <limits>

#include "core/geometry/point_grid.h"
#include "core/texture/srgb.h"

namespace flytri {
namespace {

constexpr std::size_t kGrain = 1024;

/// A point as one texture frame may see it.
struct Projection {
  float u_px = 0.0F, v_px = 0.0F;
  float depth_mm = std::numeric_limits<float>::infinity();  ///< infinite: outside of the image
  bool facing = false;
};

/// What the frames told about a point so far.
struct ColorSum {
  Vec3f chromaticity = Vec3f::Zero();  ///< sum of colors divided by their intensity
  float highest_intensity = 0.0F;
  int count = 0;
};

/// Unit ray of sight of the texture camera: along it neither U nor V changes.
Vec3 ray_of_sight(const Calibration& calibration, const Vec3& p_sensor) {
  const Vec3 ray = calibration.texture_u_px.gradient(p_sensor)
                       .cross(calibration.texture_v_px.gradient(p_sensor))
                       .normalized();
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

/// sRGB values around a place, bilinear. The place is inside the image.
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

/// One coloring of one list of points.
class Coloring {
 public:
  Coloring(std::span<SurfacePoint> points, const Calibration& calibration,
           const TextureOptions& options, const Workers& workers)
      : points_(points),
        calibration_(calibration),
        options_(options),
        workers_(workers),
        sums_(points.size()),
        projections_(points.size()) {}

  void add_frame(const TextureFrame& frame);
  ColorCounts finish();

 private:
  [[nodiscard]] Projection project(const SurfacePoint& point, const Isometry& T_sensor_world) const;
  void observe(std::size_t i, const cv::Mat& image);

  std::span<SurfacePoint> points_;
  const Calibration& calibration_;
  const TextureOptions& options_;
  const Workers& workers_;
  std::vector<ColorSum> sums_;
  std::vector<Projection> projections_;
};

Projection Coloring::project(const SurfacePoint& point, const Isometry& T_sensor_world) const {
  const Vec3 p_sensor = T_sensor_world * point.position_mm.cast<double>();
  const double margin_mm = options_.volume_margin_share * calibration_.volume.size_mm.maxCoeff();
  Projection projection;
  if (!calibration_.volume.contains(p_sensor, margin_mm)) return projection;
  const Pixel pixel = calibration_.project_to_texture(p_sensor);
  const ImageSize size = calibration_.texture_size;
  if (!(pixel.u_px >= 0.0 && pixel.v_px >= 0.0 && pixel.u_px <= size.width_px - 1 &&
        pixel.v_px <= size.height_px - 1)) {
    return projection;
  }
  const Vec3 ray = ray_of_sight(calibration_, p_sensor);
  const Vec3 normal = T_sensor_world.linear() * point.normal.cast<double>();
  projection.u_px = static_cast<float>(pixel.u_px);
  projection.v_px = static_cast<float>(pixel.v_px);
  projection.depth_mm = static_cast<float>(ray.dot(p_sensor));
  projection.facing = -normal.dot(ray) >= options_.min_facing_cosine;
  return projection;
}

void Coloring::observe(std::size_t i, const cv::Mat& image) {
  const Vec3f srgb = sample(image, projections_[i].u_px, projections_[i].v_px);
  if (srgb.maxCoeff() > static_cast<float>(options_.max_channel)) return;
  const Vec3f light(linear_from_srgb(srgb.x()), linear_from_srgb(srgb.y()),
                    linear_from_srgb(srgb.z()));
  const float intensity = light.mean();
  if (intensity <= 0.0F) return;
  ColorSum& sum = sums_[i];
  sum.chromaticity += light / intensity;
  sum.highest_intensity = std::max(sum.highest_intensity, intensity);
  ++sum.count;
}

void Coloring::add_frame(const TextureFrame& frame) {
  const Isometry T_sensor_world = frame.T_world_sensor.inverse();
  workers_.for_each(
      points_.size(), [&](std::size_t i) { projections_[i] = project(points_[i], T_sensor_world); },
      kGrain);
  DepthBuffer buffer(calibration_.texture_size, options_.depth_cell_px);
  for (const Projection& projection : projections_) {
    if (std::isfinite(projection.depth_mm)) buffer.add(projection);
  }
  const auto tolerance_mm =
      static_cast<float>(options_.depth_tolerance_share * calibration_.volume.size_mm.z());
  workers_.for_each(
      points_.size(),
      [&](std::size_t i) {
        const Projection& projection = projections_[i];
        if (!projection.facing || !std::isfinite(projection.depth_mm)) return;
        if (projection.depth_mm > buffer.closest_mm(projection) + tolerance_mm) return;
        observe(i, frame.image);
      },
      kGrain);
}

ColorCounts Coloring::finish() {
  ColorCounts counts;
  std::vector<Vec3f> observed_mm;
  std::vector<std::size_t> observed;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (sums_[i].count == 0) continue;
    const Vec3f light =
        sums_[i].highest_intensity / static_cast<float>(sums_[i].count) * sums_[i].chromaticity;
    for (int c = 0; c < 3; ++c) points_[i].color[c] = srgb_from_linear(light[c]);
    observed_mm.push_back(points_[i].position_mm);
    observed.push_back(i);
  }
  counts.observed = observed.size();
  const auto reach_mm = static_cast<float>(options_.extend_share * calibration_.volume.size_mm.x());
  if (observed.empty() || reach_mm <= 0.0F) {
    counts.untextured = points_.size() - observed.size();
    return counts;
  }
  const PointGrid grid(observed_mm, 0.25F * reach_mm);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (sums_[i].count > 0) continue;
    const auto nearest = grid.nearest(points_[i].position_mm, reach_mm);
    if (nearest) points_[i].color = points_[observed[nearest->index]].color;
    ++(nearest ? counts.extended : counts.untextured);
  }
  return counts;
}

}  // namespace

Result<void> TextureOptions::validate() const {
  const auto bad = [](std::string_view name, std::string_view range) {
    return fail(ErrorCode::kBadOption, "TextureOptions::{} must be {}", name, range);
  };
  if (!(min_facing_cosine >= 0.0 && min_facing_cosine <= 1.0)) {
    return bad("min_facing_cosine", "in [0, 1]");
  }
  if (depth_cell_px < 1) return bad("depth_cell_px", ">= 1");
  if (!(depth_tolerance_share > 0.0)) return bad("depth_tolerance_share", "> 0");
  if (!(volume_margin_share >= 0.0)) return bad("volume_margin_share", ">= 0");
  if (max_channel < 1 || max_channel > 255) return bad("max_channel", "in [1, 255]");
  if (!(extend_share >= 0.0)) return bad("extend_share", ">= 0");
  return {};
}

Result<ColorCounts> color_points(std::span<SurfacePoint> points,
                                 std::span<const TextureFrame> frames,
                                 const Calibration& calibration, const TextureOptions& options,
                                 const Workers& workers) {
  if (auto valid = options.validate(); !valid) return tl::unexpected(valid.error());
  Coloring coloring(points, calibration, options, workers);
  for (const TextureFrame& frame : frames) {
    const ImageSize size{frame.image.cols, frame.image.rows};
    if (!(size == calibration.texture_size) || frame.image.type() != CV_8UC3) {
      return fail(ErrorCode::kInconsistent,
                  "a texture frame of {} x {} px does not suit a calibration for {} x {} px",
                  size.width_px, size.height_px, calibration.texture_size.width_px,
                  calibration.texture_size.height_px);
    }
    coloring.add_frame(frame);
  }
  return coloring.finish();
}

}  // namespace flytri
