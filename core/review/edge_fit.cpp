#include "core/review/edge_fit.h"

#include <algorithm>
#include <cmath>

#include "core/base/check_options.h"
#include "core/geometry/mesh_normals.h"

namespace flytri::review {
namespace {

/// Samples of a triangle are about this far apart, mm.
constexpr double kSampleStep_mm = 0.05;
constexpr int kMaxSteps = 100;
/// Fewer independent points are no fit.
constexpr double kLeastPoints = 3.0;
/// Least noise that the fit assumes, mm, so that a perfect shape does not divide by 0.
constexpr double kLeastNoise_mm = 1e-4;

Vec2 turned_left(const Vec2& v) { return {-v.y(), v.x()}; }

double edge_length_mm(const TriangleMesh& mesh, const Triangle& t) {
  double longest_mm = 0.0;
  for (std::size_t k = 0; k < 3; ++k)
    longest_mm = std::max<double>(
        longest_mm,
        (mesh.vertices[t[k]].position_mm - mesh.vertices[t[(k + 1) % 3]].position_mm).norm());
  return longest_mm;
}

}  // namespace

Result<void> EdgeFitOptions::validate() const {
  return OptionCheck("EdgeFitOptions")
      .positive("gap_mm", gap_mm)
      .above("reach_mm", reach_mm, gap_mm)
      .positive("half_width_mm", half_width_mm)
      .positive("bend_per_mm", bend_per_mm)
      .positive("least_turn_rad", least_turn_rad)
      .result();
}

EdgeSurface::EdgeSurface(const TriangleMesh& mesh, std::span<const Vec3> line_mm,
                         const EdgeFitOptions& options)
    : options_(options) {
  std::vector<Vec3f> places_mm;
  for (const Vec3& p_mm : line_mm) places_mm.push_back(p_mm.cast<float>());
  const double far_mm = 2.0 * (options.reach_mm + options.half_width_mm);
  const PointGrid near_line(places_mm, static_cast<float>(far_mm));
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle& triangle = mesh.triangles[t];
    const bool near = std::any_of(triangle.begin(), triangle.end(), [&](std::uint32_t v) {
      return near_line.nearest(mesh.vertices[v].position_mm, static_cast<float>(far_mm))
          .has_value();
    });
    if (near) add_triangle(mesh, t);
  }
  std::vector<Vec3f> at_mm;
  for (const Sample& sample : samples_) at_mm.push_back(sample.position_mm.cast<float>());
  grid_.emplace(at_mm, static_cast<float>(options.reach_mm));
}

/// Adds the middles of equal parts.
void EdgeSurface::add_triangle(const TriangleMesh& mesh, std::uint32_t triangle) {
  const Triangle& t = mesh.triangles[triangle];
  const Vec3 area_mm2 = area_vector_mm2(mesh, t);
  if (!(area_mm2.norm() > 0.0)) return;
  const auto steps = static_cast<int>(
      std::clamp(std::ceil(edge_length_mm(mesh, t) / kSampleStep_mm), 1.0, double{kMaxSteps}));
  const auto corner = [&](std::size_t k) -> Vec3 {
    return mesh.vertices[t[k]].position_mm.cast<double>();
  };
  double sigma_mm = 0.0;
  for (const std::uint32_t v : t) {
    if (std::isfinite(mesh.vertices[v].sigma_mm)) sigma_mm += mesh.vertices[v].sigma_mm / 3.0;
  }
  for (int i = 0; i < steps; ++i)
    for (int j = 0; i + j < steps; ++j)
      for (const double middle : {1.0 / 3.0, 2.0 / 3.0}) {
        if (middle > 0.5 && i + j + 1 >= steps) continue;
        const double a = (i + middle) / steps, b = (j + middle) / steps;
        samples_.push_back({a * corner(0) + b * corner(1) + (1.0 - a - b) * corner(2),
                            area_mm2.normalized(), area_mm2.norm() / (steps * steps), sigma_mm,
                            triangle});
      }
}

/// The parabola h = a + b s + c s^2 of a flank: s away from the edge, h along its mean normal. Its
/// tangent at s = 0.
std::optional<EdgeSurface::Flank> EdgeSurface::fit_flank(const std::vector<Seen>& seen,
                                                         double side) const {
  Vec2 sum = Vec2::Zero();
  double area_mm2 = 0.0, sigma_mm = 0.0;
  std::vector<std::uint32_t> triangles;
  const auto counts = [&](const Seen& s) {
    const double away_mm = s.at_mm.norm();
    return s.at_mm.x() * side > 0.0 && away_mm >= options_.gap_mm && away_mm <= options_.reach_mm;
  };
  for (const Seen& s : seen) {
    if (!counts(s)) continue;
    sum += s.sample->area_mm2 * s.at_mm;
    area_mm2 += s.sample->area_mm2;
    sigma_mm += s.sample->area_mm2 * s.sample->sigma_mm;
    triangles.push_back(s.sample->triangle);
  }
  std::sort(triangles.begin(), triangles.end());
  triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
  const double points = 0.5 * static_cast<double>(triangles.size());
  if (points < kLeastPoints || !(area_mm2 > 0.0) || !(sum.norm() > 0.0)) return std::nullopt;
  const Vec2 away = sum.normalized(), out = side * turned_left(away);
  const double noise_mm = std::max(sigma_mm / area_mm2, kLeastNoise_mm);
  Eigen::Matrix3d sums = Eigen::Matrix3d::Zero();
  Vec3 right = Vec3::Zero();
  double squares = 0.0;
  for (const Seen& s : seen) {
    if (!counts(s)) continue;
    const double x = away.dot(s.at_mm), h = out.dot(s.at_mm);
    const double weight = points * s.sample->area_mm2 / area_mm2;
    const Vec3 powers(1.0, x, x * x);
    sums += weight * powers * powers.transpose();
    right += weight * h * powers;
    squares += weight * h * h;
  }
  // What is left tells the noise, where the mesh does not; so it is found twice.
  double used_mm = std::max(noise_mm, 5e-3);
  Vec3 solved = Vec3::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (int round = 0; round < 2; ++round) {
    Eigen::Matrix3d system = sums / (used_mm * used_mm);
    system(2, 2) += 1.0 / (options_.bend_per_mm * options_.bend_per_mm);
    covariance = system.inverse();
    solved = covariance * right / (used_mm * used_mm);
    const double left = squares - 2.0 * solved.dot(right) + solved.dot(sums * solved);
    used_mm = std::max(noise_mm, std::sqrt(std::max(left, 0.0) / std::max(points - 2.0, 1.0)));
  }
  Flank flank;
  flank.place_mm = solved[0] * out;
  flank.normal = (out - solved[1] * away).normalized();
  flank.sigma_mm = std::sqrt(std::max(covariance(0, 0), 0.0));
  return flank;
}

std::optional<EdgeSurface::Edge> EdgeSurface::fit(const Vec3& place_mm, const Vec3& along) const {
  std::vector<Neighbor> found;
  grid_->within(place_mm.cast<float>(),
                static_cast<float>(std::hypot(options_.reach_mm, options_.half_width_mm)), found);
  // The order of the sums must not depend on the grid.
  std::sort(found.begin(), found.end(),
            [](const Neighbor& a, const Neighbor& b) { return a.index < b.index; });
  Vec3 mean_normal = Vec3::Zero();
  for (const Neighbor& neighbor : found)
    mean_normal += samples_[neighbor.index].area_mm2 * samples_[neighbor.index].normal;
  const Vec3 up = (mean_normal - mean_normal.dot(along) * along).stableNormalized();
  if (!(up.norm() > 0.5)) return std::nullopt;
  const Vec3 across = along.cross(up);
  std::vector<Seen> seen;
  for (const Neighbor& neighbor : found) {
    const Sample& sample = samples_[neighbor.index];
    const Vec3 d = sample.position_mm - place_mm;
    if (std::abs(along.dot(d)) > options_.half_width_mm || sample.normal.dot(up) < 0.0) continue;
    seen.push_back({{across.dot(d), up.dot(d)}, &sample});
  }
  const auto left = fit_flank(seen, -1.0), right = fit_flank(seen, 1.0);
  if (!left || !right) return std::nullopt;
  Edge edge;
  // Positive: the flanks fall away on both sides.
  const double sine = left->normal.x() * right->normal.y() - left->normal.y() * right->normal.x();
  edge.turn_rad = std::atan2(-sine, left->normal.dot(right->normal));
  if (edge.turn_rad < options_.least_turn_rad) return std::nullopt;
  Eigen::Matrix2d normals;
  normals << left->normal.transpose(), right->normal.transpose();
  const Eigen::Matrix2d inverse = normals.inverse();
  const Vec2 at_mm =
      inverse * Vec2(left->normal.dot(left->place_mm), right->normal.dot(right->place_mm));
  const Eigen::Matrix2d spread = inverse * Vec2(left->sigma_mm, right->sigma_mm).asDiagonal();
  if (!(at_mm.norm() <= options_.reach_mm)) return std::nullopt;
  edge.place_mm = place_mm + at_mm.x() * across + at_mm.y() * up;
  edge.sigma_mm = spread.norm() / std::sqrt(2.0);
  return edge;
}

}  // namespace flytri::review
