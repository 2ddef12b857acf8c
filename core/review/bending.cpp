#include "core/review/bending.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace flytri::review {
namespace {

std::vector<Vec3f> bending_places(const TriangleMesh& mesh) {
  std::vector<Vec3f> places_mm;
  places_mm.reserve(mesh.vertices.size());
  for (const SurfacePoint& vertex : mesh.vertices) places_mm.push_back(vertex.position_mm);
  return places_mm;
}

/// The larger eigenvalue of the symmetric 2 x 2 matrix (xx, xy; xy, yy).
double larger_eigenvalue(const Vec3& matrix) {
  return 0.5 * (matrix[0] + matrix[2]) + std::hypot(0.5 * (matrix[0] - matrix[2]), matrix[1]);
}

}  // namespace

Bending::Bending(const TriangleMesh& mesh, double radius_mm)
    : mesh_(mesh),
      radius_mm_(radius_mm),
      grid_(bending_places(mesh), static_cast<float>(radius_mm)),
      known_(mesh.vertices.size(), std::numeric_limits<float>::quiet_NaN()) {}

void Bending::near(const Vec3& p_mm, double radius_mm, std::vector<Neighbor>& found) const {
  grid_.within(p_mm.cast<float>(), static_cast<float>(radius_mm), found);
}

double Bending::convexity(std::uint32_t vertex) {
  if (std::isnan(known_[vertex])) known_[vertex] = static_cast<float>(fit(vertex));
  return known_[vertex];
}

double Bending::fit(std::uint32_t vertex) {
  const SurfacePoint& center = mesh_.vertices[vertex];
  near(center.position_mm.cast<double>(), radius_mm_, around_);
  // The order of the sums must not depend on the grid.
  std::sort(around_.begin(), around_.end(),
            [](const Neighbor& a, const Neighbor& b) { return a.index < b.index; });
  Vec3 mean_normal = Vec3::Zero(), mean_mm = Vec3::Zero();
  std::vector<std::uint32_t> used;
  for (const Neighbor& neighbor : around_) {
    const SurfacePoint& point = mesh_.vertices[neighbor.index];
    if (point.normal.dot(center.normal) < -0.2F) continue;  // the back of something thin
    used.push_back(neighbor.index);
    mean_normal += point.normal.cast<double>();
    mean_mm += point.position_mm.cast<double>();
  }
  if (used.size() < 6 || !(mean_normal.norm() > 0.1)) return 0.0;
  mean_mm /= static_cast<double>(used.size());
  const Vec3 up = mean_normal.normalized();
  const Vec3 u = up.unitOrthogonal(), v = up.cross(u);
  mean_normal /= static_cast<double>(used.size());
  Eigen::Matrix3d sums = 1e-9 * Eigen::Matrix3d::Identity();
  Vec3 right = Vec3::Zero();
  for (const std::uint32_t i : used) {
    const Vec3 d = mesh_.vertices[i].position_mm.cast<double>() - mean_mm;
    const Vec3 turn = mesh_.vertices[i].normal.cast<double>() - mean_normal;
    const double x = u.dot(d), y = v.dot(d), a = u.dot(turn), b = v.dot(turn);
    // a = xx x + xy y, b = xy x + yy y
    sums += Vec3(x, y, 0.0) * Vec3(x, y, 0.0).transpose() +
            Vec3(0.0, x, y) * Vec3(0.0, x, y).transpose();
    right += Vec3(x, y, 0.0) * a + Vec3(0.0, x, y) * b;
  }
  return std::max(0.0, larger_eigenvalue(sums.ldlt().solve(right)));
}

}  // namespace flytri::review
