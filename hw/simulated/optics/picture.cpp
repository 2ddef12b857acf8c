#include "hw/simulated/optics/picture.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/check_options.h"
#include "core/base/random.h"
#include "hw/simulated/optics/ray_scene.h"

namespace flytri::simulated {
namespace {

// Shares of ambient light and of the lamp beside the viewer.
constexpr double kSkyShare = 0.55;
constexpr double kLampShare = 0.45;
// Range of the darkening of crevices, as a share of the mesh's radius.
constexpr double kOcclusionReach = 0.12;

// Draws one mesh. Immutable, so that rows can be drawn in parallel.
class Painter {
 public:
  Painter(const TexturedMesh& textured, const PictureOptions& options)
      : textured_(textured), options_(options), scene_(textured.mesh) {
    Eigen::AlignedBox3f box;
    for (const SurfacePoint& vertex : textured.mesh.vertices) box.extend(vertex.position_mm);
    center_ = box.center().cast<double>();
    towards_eye_ = options.from_direction.normalized();
    right_ = options.up.cross(towards_eye_).normalized();
    up_ = towards_eye_.cross(right_);
    Vec2 reach = Vec2::Zero();
    for (const SurfacePoint& vertex : textured.mesh.vertices) {
      const Vec3 p = vertex.position_mm.cast<double>() - center_;
      reach = reach.cwiseMax(Vec2(std::abs(p.dot(right_)), std::abs(p.dot(up_))));
      radius_mm_ = std::max(radius_mm_, p.norm());
    }
    const double fit =
        std::max(2.0 * reach.x() / options.size.width_px, 2.0 * reach.y() / options.size.height_px);
    pixel_mm_ = 1.04 * fit / options.zoom;
  }

  void draw_row(int v, cv::Mat& image) const {
    const int n = options_.samples_per_axis;
    for (int u = 0; u < options_.size.width_px; ++u) {
      Vec3 sum = Vec3::Zero();
      for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) sum += color_seen_at(u + (x + 0.5) / n, v + (y + 0.5) / n);
      auto& pixel = image.at<cv::Vec3b>(v, u);
      for (int channel = 0; channel < 3; ++channel)
        pixel[channel] =
            static_cast<std::uint8_t>(std::clamp(std::lround(sum[channel] / (n * n)), 0L, 255L));
    }
  }

 private:
  Vec3 color_seen_at(double u, double v) const {
    const double x = (u - 0.5 * options_.size.width_px) * pixel_mm_;
    const double y = (0.5 * options_.size.height_px - v) * pixel_mm_;
    const Vec3 eye = center_ + x * right_ + y * up_ + 2.0 * radius_mm_ * towards_eye_;
    const auto hit = scene_.first_hit({eye, -towards_eye_});
    if (!hit)
      return {1.0 * options_.background[0], 1.0 * options_.background[1],
              1.0 * options_.background[2]};
    Vec3 normal = smooth_normal_at(textured_.mesh, *hit);
    if (normal.dot(towards_eye_) < 0.0) normal = -normal;
    const Vec3 lamp = (towards_eye_ + 0.35 * up_ - 0.45 * right_).normalized();
    const double sky = kSkyShare * (0.75 + 0.25 * normal.dot(up_)) * openness(*hit, normal, u, v);
    const double direct = kLampShare * std::max(normal.dot(lamp), 0.0);
    return std::min(sky + direct, 1.0) * albedo(*hit);
  }

  // Visible share of the sky at a place, weighted by the cosine (ambient occlusion).
  double openness(const RayHit& hit, const Vec3& normal, double u, double v) const {
    if (options_.occlusion_rays == 0) return 1.0;
    Random random(static_cast<std::uint64_t>(std::lround(u * 64.0)),
                  static_cast<std::uint64_t>(std::lround(v * 64.0)));
    const Vec3 tangent = normal.unitOrthogonal();
    const Vec3 other = normal.cross(tangent);
    int open = 0;
    for (int i = 0; i < options_.occlusion_rays; ++i) {
      const double radius = std::sqrt((i + random.uniform()) / options_.occlusion_rays);
      const double angle = 2.0 * std::numbers::pi * random.uniform();
      const Vec3 direction = radius * std::cos(angle) * tangent + radius * std::sin(angle) * other +
                             std::sqrt(1.0 - radius * radius) * normal;
      const Vec3 end = hit.point_mm + kOcclusionReach * radius_mm_ * direction;
      if (!scene_.blocked(hit.point_mm, normal, end)) ++open;
    }
    return static_cast<double>(open) / options_.occlusion_rays;
  }

  Vec3 albedo(const RayHit& hit) const {
    if (!options_.show_colors)
      return {1.0 * kUntexturedColor[0], 1.0 * kUntexturedColor[1], 1.0 * kUntexturedColor[2]};
    if (textured_.atlas.empty() || textured_.uv.empty()) return color_at(textured_.mesh, hit);
    Eigen::Vector2d uv = Eigen::Vector2d::Zero();
    for (int corner = 0; corner < 3; ++corner)
      uv += hit.weights[corner] *
            textured_.uv[textured_.mesh.triangles[hit.triangle][corner]].cast<double>();
    const int column =
        std::clamp(static_cast<int>(uv.x() * textured_.atlas.cols), 0, textured_.atlas.cols - 1);
    const int row =
        std::clamp(static_cast<int>(uv.y() * textured_.atlas.rows), 0, textured_.atlas.rows - 1);
    const auto& texel = textured_.atlas.at<cv::Vec3b>(row, column);
    return {1.0 * texel[0], 1.0 * texel[1], 1.0 * texel[2]};
  }

  const TexturedMesh& textured_;
  const PictureOptions& options_;
  RayScene scene_;
  Vec3 center_, towards_eye_, right_, up_;
  double radius_mm_ = 0.0;
  double pixel_mm_ = 1.0;
};

}  // namespace

Result<void> PictureOptions::validate() const {
  return OptionCheck("PictureOptions")
      .at_least("size.width_px", size.width_px, 1)
      .at_least("size.height_px", size.height_px, 1)
      .must("up", "along from_direction", from_direction.cross(up).norm() > 1e-9,
            "across from_direction")
      .positive("zoom", zoom)
      .in_range("samples_per_axis", samples_per_axis, 1, 8)
      .in_range("occlusion_rays", occlusion_rays, 0, 256)
      .result();
}

Result<cv::Mat> draw_picture(const TexturedMesh& mesh, const PictureOptions& options,
                             const Workers& workers) {
  if (auto valid = options.validate(); !valid) return tl::unexpected(valid.error());
  if (mesh.mesh.triangles.empty())
    return fail(ErrorCode::kInsufficient, "the mesh to be drawn has no triangles");
  const Painter painter(mesh, options);
  cv::Mat image(options.size.height_px, options.size.width_px, CV_8UC3);
  workers.for_each(
      static_cast<std::size_t>(image.rows),
      [&](std::size_t v) { painter.draw_row(static_cast<int>(v), image); }, 8);
  return image;
}

}  // namespace flytri::simulated
