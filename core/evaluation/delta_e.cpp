#include "core/evaluation/delta_e.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/median.h"
#include "core/geometry/mesh_distance.h"
#include "core/texture/srgb.h"
#include "core/texture/vertex_colors.h"

namespace flytri::evaluation {
namespace {

constexpr std::size_t kDeltaGrain = 256;

Vec3 light_of(const Rgb& color) {
  return Vec3f(texture::linear_from_srgb(color[0]), texture::linear_from_srgb(color[1]),
               texture::linear_from_srgb(color[2]))
      .cast<double>();
}

/// Share of luminance, Y.
double luminance(const Vec3& light) { return Vec3(0.2126729, 0.7151522, 0.0721750).dot(light); }

/// CIELAB of linear sRGB light, white D65.
/// @source  IEC 61966-2-1 (XYZ of sRGB); CIE 15.
Vec3 lab_of(const Vec3& light) {
  Eigen::Matrix3d xyz_of_rgb;
  xyz_of_rgb << 0.4124564, 0.3575761, 0.1804375, 0.2126729, 0.7151522, 0.0721750, 0.0193339,
      0.1191920, 0.9503041;
  const Vec3 white = xyz_of_rgb * Vec3::Ones();
  const Vec3 xyz = (xyz_of_rgb * light).cwiseQuotient(white);
  const Vec3 f = xyz.unaryExpr([](double t) {
    constexpr double kKnee = 6.0 / 29.0;
    return t > kKnee * kKnee * kKnee ? std::cbrt(t) : t / (3.0 * kKnee * kKnee) + 4.0 / 29.0;
  });
  return {116.0 * f.y() - 16.0, 500.0 * (f.x() - f.y()), 200.0 * (f.y() - f.z())};
}

/// Light of the surface at a point of one of its triangles.
Vec3 light_at(const TriangleMesh& mesh, const MeshDistance::Closest& closest) {
  const Triangle& t = mesh.triangles[closest.triangle];
  const Vec3f& a = mesh.vertices[t[0]].position_mm;
  const Vec3f u = mesh.vertices[t[1]].position_mm - a, v = mesh.vertices[t[2]].position_mm - a;
  const Vec3f w = closest.point_mm - a;
  const double uu = u.dot(u), uv = u.dot(v), vv = v.dot(v), uw = u.dot(w), vw = v.dot(w);
  const double area = std::max(uu * vv - uv * uv, 1e-20);
  const double b = (vv * uw - uv * vw) / area, c = (uu * vw - uv * uw) / area;
  return (1.0 - b - c) * light_of(mesh.vertices[t[0]].color) +
         b * light_of(mesh.vertices[t[1]].color) + c * light_of(mesh.vertices[t[2]].color);
}

/// Found and true light of a vertex.
struct LightPair {
  Vec3 found = Vec3::Zero(), truth = Vec3::Zero();
  bool is_near = false;
};

double gain_of(const std::vector<LightPair>& pairs) {
  std::vector<double> ratios;
  ratios.reserve(pairs.size());
  for (const LightPair& pair : pairs) {
    ratios.push_back(std::max(luminance(pair.truth), 1e-4) / std::max(luminance(pair.found), 1e-4));
  }
  return median_of(ratios);
}

}  // namespace

DeltaE delta_e(const TexturedMesh& result, const TriangleMesh& truth, double within_mm,
               const Workers& workers) {
  const MeshDistance surface(truth);
  std::vector<LightPair> pairs(result.mesh.vertices.size());
  workers.for_each(
      pairs.size(),
      [&](std::size_t i) {
        const auto closest = surface.closest(result.mesh.vertices[i].position_mm, within_mm);
        if (!std::isfinite(closest.distance_mm)) return;
        pairs[i] = {light_of(texture::vertex_color(result, i)), light_at(truth, closest), true};
      },
      kDeltaGrain);
  std::erase_if(pairs, [](const LightPair& pair) { return !pair.is_near; });
  DeltaE error;
  error.count = static_cast<std::int64_t>(pairs.size());
  if (pairs.empty()) return error;
  error.gain = gain_of(pairs);
  std::vector<double> differences(pairs.size());
  workers.for_each(
      pairs.size(),
      [&](std::size_t i) {
        const Vec3 found = (error.gain * pairs[i].found).cwiseMin(1.0);
        differences[i] = (lab_of(found) - lab_of(pairs[i].truth)).norm();
      },
      kDeltaGrain);
  std::sort(differences.begin(), differences.end());
  error.median = quantile_of(differences, 0.5);
  error.percentile_95 = quantile_of(differences, 0.95);
  return error;
}

}  // namespace flytri::evaluation
