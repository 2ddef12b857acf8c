#include "core/texture/observe.h"

#include <array>
#include <cmath>

#include "core/base/check_options.h"
#include "core/texture/srgb.h"

namespace flytri::texture {
namespace {

/// Weight that is left at the border of the image: better than no color.
constexpr double kBorderWeight = 0.01;
/// Weight beside a step in depth, where a pixel may show the surface in front.
constexpr double kStepWeight = 0.05;
/// A step is this many times as deep as what hides a point: steep surface is no step.
constexpr float kStepDepths = 2.0F;
/// The weight falls over this many values below the saturation: light spreads to the neighbors.
constexpr float kNearSaturation = 20.0F;

/// Linear light of the 256 values.
const std::array<float, 256>& light_table() {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> values{};
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i] = linear_from_srgb(static_cast<float>(i));
    }
    return values;
  }();
  return table;
}

/// Linear light at a place in the image, interpolated, and the brightest of the pixels used.
struct Sampled {
  Vec3f light = Vec3f::Zero();
  std::uint8_t brightest = 0;
};
Sampled sample(const cv::Mat& image, const Pixel& pixel) {
  const int u = std::min(static_cast<int>(pixel.u_px), image.cols - 2);
  const int v = std::min(static_cast<int>(pixel.v_px), image.rows - 2);
  const auto a = static_cast<float>(pixel.u_px - u);
  const auto b = static_cast<float>(pixel.v_px - v);
  const std::array<float, 256>& light = light_table();
  Sampled sampled;
  for (const int dv : {0, 1}) {
    for (const int du : {0, 1}) {
      const auto& value = image.at<cv::Vec3b>(v + dv, u + du);
      const float weight = (du == 1 ? a : 1.0F - a) * (dv == 1 ? b : 1.0F - b);
      for (int c = 0; c < 3; ++c) sampled.light[c] += weight * light[value[c]];
      if (weight > 0.0F) {
        sampled.brightest = std::max({sampled.brightest, value[0], value[1], value[2]});
      }
    }
  }
  return sampled;
}

double margin_of(const calibration::Calibration& calibration, const TextureOptions& options) {
  return options.volume_margin_share * calibration.volume.size_mm.maxCoeff();
}

bool is_inside(const Pixel& pixel, const ImageSize& size) {
  return pixel.u_px >= 0.0 && pixel.v_px >= 0.0 && pixel.u_px <= size.width_px - 1 &&
         pixel.v_px <= size.height_px - 1;
}

/// Vector along the texture camera's ray of sight: U and V do not change along it. Its length is
/// the number of pixels per square millimeter perpendicular to the ray.
Vec3 pixels_along_ray(const calibration::Calibration& calibration, const Vec3& p_sensor) {
  const Vec3 ray = calibration.texture_u_px.gradient(p_sensor).cross(
      calibration.texture_v_px.gradient(p_sensor));
  return ray.z() < 0.0 ? Vec3(-ray) : ray;
}

/// Rises smoothly from 0 to 1.
double smooth_step(double share) {
  const double s = std::clamp(share, 0.0, 1.0);
  return s * s * (3.0 - 2.0 * s);
}

}  // namespace

void ObservedColor::add(const Observation& observation) {
  sum_ += observation.weight * observation.albedo;
  weight_ += observation.weight;
}

Rgb ObservedColor::color() const { return to_color(sum_ / weight_); }

Rgb to_color(const Vec3f& light) {
  Rgb color;
  for (int c = 0; c < 3; ++c) color[static_cast<std::size_t>(c)] = srgb_from_linear(light[c]);
  return color;
}

std::vector<BoundingSphere> block_spheres(std::span<const SurfacePoint> points,
                                          const Workers& workers) {
  std::vector<BoundingSphere> spheres((points.size() + kPointBlock - 1) / kPointBlock);
  workers.for_each(
      spheres.size(),
      [&](std::size_t b) {
        Eigen::AlignedBox3f box;
        const std::size_t end = std::min(points.size(), (b + 1) * kPointBlock);
        for (std::size_t i = b * kPointBlock; i < end; ++i) box.extend(points[i].position_mm);
        spheres[b] = {0.5F * (box.min() + box.max()), 0.5F * (box.max() - box.min()).norm()};
      },
      16);
  return spheres;
}

FrameObserver::FrameObserver(const TextureFrame& frame, const calibration::Calibration& calibration,
                             const TextureOptions& options)
    : frame_(frame),
      calibration_(calibration),
      options_(options),
      T_sensor_world_(frame.T_world_sensor.inverse()),
      shading_(calibration),
      depths_(calibration.texture_size, options.depth_cell_px),
      margin_mm_(margin_of(calibration, options)) {}

bool FrameObserver::may_see(const Vec3f& middle_mm, float radius_mm) const {
  return calibration_.volume.contains(T_sensor_world_ * middle_mm.cast<double>(),
                                      margin_mm_ + static_cast<double>(radius_mm));
}

std::optional<Pixel> FrameObserver::project(const Vec3& p_sensor) const {
  if (!calibration_.volume.contains(p_sensor, margin_mm_)) return std::nullopt;
  const Pixel pixel = calibration_.project_to_texture(p_sensor);
  if (!is_inside(pixel, calibration_.texture_size)) return std::nullopt;
  return pixel;
}

void FrameObserver::find_depths(std::span<const SurfacePoint> points,
                                std::span<const BoundingSphere> spheres, const Workers& workers) {
  struct Depth {
    Pixel pixel;
    float depth_mm;
  };
  std::vector<std::vector<Depth>> blocks(spheres.size());
  workers.for_each(blocks.size(), [&](std::size_t b) {
    if (!may_see(spheres[b].middle_mm, spheres[b].radius_mm)) return;
    const std::size_t first = b * kPointBlock;
    for (const SurfacePoint& point :
         points.subspan(first, std::min(kPointBlock, points.size() - first))) {
      const Vec3 p_sensor = T_sensor_world_ * point.position_mm.cast<double>();
      const auto pixel = project(p_sensor);
      if (!pixel) continue;
      blocks[b].push_back({*pixel, static_cast<float>(shading_.depth_mm(p_sensor))});
    }
  });
  for (const auto& block : blocks) {
    for (const Depth& depth : block) depths_.add(depth.pixel, depth.depth_mm);
  }
}

double FrameObserver::border_share(const Vec3& p_sensor, const Pixel& pixel) const {
  const ImageSize& size = calibration_.texture_size;
  const double beside_px = std::min(
      {pixel.u_px, pixel.v_px, size.width_px - 1 - pixel.u_px, size.height_px - 1 - pixel.v_px});
  const Vec3 half_mm = 0.5 * calibration_.volume.size_mm;
  const Vec3 inside_mm = half_mm + Vec3::Constant(margin_mm_) - p_sensor.cwiseAbs();
  const double in_volume = inside_mm.cwiseQuotient(half_mm).minCoeff() / options_.fade_share;
  const double in_image = beside_px / (0.5 * options_.fade_share * size.width_px);
  return std::max(kBorderWeight, smooth_step(in_volume) * smooth_step(in_image));
}

std::optional<Observation> FrameObserver::observe(const SurfacePoint& point) const {
  const Vec3 p_sensor = T_sensor_world_ * point.position_mm.cast<double>();
  const auto pixel = project(p_sensor);
  if (!pixel) return std::nullopt;
  const ImageSize& size = calibration_.texture_size;
  const double du = pixel->u_px - 0.5 * size.width_px, dv = pixel->v_px - 0.5 * size.height_px;
  const double diagonal2 = std::pow(size.width_px, 2) + std::pow(size.height_px, 2);
  const Shading::Incidence seen =
      shading_.incidence(p_sensor, T_sensor_world_.linear() * point.normal.cast<double>(),
                         4.0 * (du * du + dv * dv) / diagonal2);
  if (seen.eye_cosine < options_.min_facing_cosine || seen.lamp_cosine < options_.min_lamp_cosine)
    return std::nullopt;
  const auto tolerance_mm =
      static_cast<float>(options_.depth_tolerance_share * calibration_.volume.size_mm.z());
  const auto depth_mm = static_cast<float>(shading_.depth_mm(p_sensor));
  if (depth_mm > depths_.closest_mm(*pixel) + tolerance_mm) return std::nullopt;
  if (frame_.serves && !frame_.serves(point.position_mm, point.normal)) return std::nullopt;
  const Sampled sampled = sample(frame_.image, *pixel);
  if (sampled.brightest > options_.max_channel || !(sampled.light.sum() > 0.0F))
    return std::nullopt;
  // Close to the limits of the angles the weight is small, so that nothing jumps there.
  const double steep = (seen.eye_cosine - 0.9 * options_.min_facing_cosine) *
                       (seen.lamp_cosine - 0.9 * options_.min_lamp_cosine);
  double weight = steep * steep * border_share(p_sensor, *pixel);
  if (depth_mm > depths_.closest_around_mm(*pixel) + kStepDepths * tolerance_mm)
    weight *= kStepWeight;
  const float below = static_cast<float>(options_.max_channel - sampled.brightest);
  weight *= std::min(1.0F, (below + 1.0F) / kNearSaturation);
  const auto light = static_cast<float>(seen.lamp_cosine * seen.light);
  return Observation{
      sampled.light.cwiseQuotient(shading_.channels()).cwiseProduct(frame_.gain) / light,
      static_cast<float>(weight)};
}

double pixels_per_mm2(const SurfacePoint& point, const Isometry& T_sensor_world,
                      const calibration::Calibration& calibration, const TextureOptions& options) {
  const Vec3 p_sensor = T_sensor_world * point.position_mm.cast<double>();
  if (!calibration.volume.contains(p_sensor, margin_of(calibration, options))) return 0.0;
  if (!is_inside(calibration.project_to_texture(p_sensor), calibration.texture_size)) return 0.0;
  const Vec3 normal = T_sensor_world.linear() * point.normal.cast<double>();
  const Vec3 pixels = pixels_along_ray(calibration, p_sensor);
  const double facing = -pixels.dot(normal);
  return facing >= options.min_facing_cosine * pixels.norm() ? facing : 0.0;
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

Result<void> TextureOptions::validate() const {
  return OptionCheck("TextureOptions")
      .in_range("min_facing_cosine", min_facing_cosine, 0.0, 1.0)
      .in_range("min_lamp_cosine", min_lamp_cosine, 0.0, 1.0)
      .at_least("depth_cell_px", depth_cell_px, 1)
      .positive("depth_tolerance_share", depth_tolerance_share)
      .not_negative("volume_margin_share", volume_margin_share)
      .in_range("max_channel", max_channel, 1, 255)
      .positive("fade_share", fade_share)
      .not_negative("extend_share", extend_share)
      .result();
}

}  // namespace flytri::texture
