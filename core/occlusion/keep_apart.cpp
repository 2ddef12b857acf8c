#include "core/occlusion/keep_apart.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/geometry/mesh_normals.h"

namespace flytri::occlusion {
namespace {

/// Of the distance of two finished surfaces, mm, and the area over which errors belong together.
constexpr double kSurface_mm = 0.015, kTogether_mm2 = 1.0;
/// Deeper than so many standard uncertainties is no error of the relation.
constexpr double kLargestSigmas = 4.0;
/// Vertices farther from the other jaw than this cannot come to penetrate it.
constexpr double kMeetReach_mm = 0.3;
constexpr int kMaxPushes = 20;
/// Far below the uncertainty, mm and rad.
constexpr double kSmallPush = 1e-6;

/// A vertex of the lower jaw near the upper one.
struct Near {
  std::uint32_t vertex = 0;
  double area_mm2 = 0.0;
};

std::vector<double> vertex_areas_mm2(const TriangleMesh& mesh) {
  std::vector<double> areas_mm2(mesh.vertices.size(), 0.0);
  for (const Triangle& triangle : mesh.triangles) {
    const double share_mm2 = area_vector_mm2(mesh, triangle).norm() / 3.0;
    for (const std::uint32_t v : triangle) areas_mm2[v] += share_mm2;
  }
  return areas_mm2;
}

/// Where a vertex lies against the upper jaw, frame of the upper jaw.
struct Meeting {
  Vec3 p_mm = Vec3::Zero(), normal = Vec3::UnitZ();
  double offset_mm = 0.0;  ///< negative: inside the upper jaw
};

std::optional<Meeting> meet(const JawSurface& upper, const SurfacePoint& vertex,
                            const Isometry& T_upper_lower) {
  const Vec3 p_mm = T_upper_lower * vertex.position_mm.cast<double>();
  const auto foot = upper.foot(p_mm, kMeetReach_mm);
  if (!foot) return std::nullopt;
  // The back of a thin part does not face it.
  if (foot->normal.dot(T_upper_lower.linear() * vertex.normal.cast<double>()) > 0.0)
    return std::nullopt;
  return Meeting{p_mm, foot->normal, foot->offset_mm};
}

std::vector<Near> near_vertices(const JawSurface& upper, const TriangleMesh& lower,
                                const Isometry& T_upper_lower, const Workers& workers) {
  std::vector<char> is_near(lower.vertices.size(), 0);
  workers.for_each(
      is_near.size(),
      [&](std::size_t i) { is_near[i] = meet(upper, lower.vertices[i], T_upper_lower) ? 1 : 0; },
      256);
  const std::vector<double> areas_mm2 = vertex_areas_mm2(lower);
  std::vector<Near> near;
  for (std::size_t i = 0; i < is_near.size(); ++i) {
    if (is_near[i] != 0) near.push_back({static_cast<std::uint32_t>(i), areas_mm2[i]});
  }
  return near;
}

}  // namespace

double keep_apart(const JawSurface& upper, const TriangleMesh& lower, const Workers& workers,
                  Occlusion& found) {
  const Isometry T_before = found.T_upper_lower;
  const std::vector<Near> near = near_vertices(upper, lower, T_before, workers);
  const Matrix6 precision = inverse_of_symmetric(found.covariance);
  std::vector<std::optional<Meeting>> meetings(near.size());
  Twist moved = Twist::Zero();
  double farthest_mm = 0.0;
  for (int i = 0; i < kMaxPushes; ++i) {
    workers.for_each(
        near.size(),
        [&](std::size_t k) {
          meetings[k] = meet(upper, lower.vertices[near[k].vertex], found.T_upper_lower);
        },
        256);
    Matrix6 matrix = precision;
    Twist gradient = precision * moved;
    farthest_mm = 0.0;
    for (std::size_t k = 0; k < near.size(); ++k) {
      if (!meetings[k] || meetings[k]->offset_mm >= 0.0) continue;
      const Meeting& at = *meetings[k];
      Twist row;
      row << (at.p_mm - found.middle_mm).cross(at.normal), at.normal;
      const double explained_mm =
          std::sqrt(kSurface_mm * kSurface_mm + row.dot(found.covariance * row));
      if (at.offset_mm < -kLargestSigmas * explained_mm) continue;
      const double weight = near[k].area_mm2 / (kTogether_mm2 * kSurface_mm * kSurface_mm);
      matrix += weight * row * row.transpose();
      gradient += weight * at.offset_mm * row;
      farthest_mm = std::max(farthest_mm,
                             (T_before * found.T_upper_lower.inverse() * at.p_mm - at.p_mm).norm());
    }
    const Twist step = solve_symmetric(matrix, -gradient);
    moved += step;
    found.T_upper_lower = Eigen::Translation3d(found.middle_mm) * exp_twist(moved) *
                          Eigen::Translation3d(-found.middle_mm) * T_before;
    if (step.norm() < kSmallPush) break;
  }
  return farthest_mm;
}

}  // namespace flytri::occlusion
