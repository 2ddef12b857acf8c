#include "core/occlusion/patient_frame.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "core/geometry/decompositions.h"

namespace flytri::occlusion {
namespace {

/// About half a tooth: each cell has the top of a cusp or an edge.
constexpr double kTopCell_mm = 3.0;
/// Of the tops, those so far below the highest belong to teeth; those of the gum lie deeper.
constexpr double kTeeth_mm = 3.0;
/// "The highest" is this share of the tops, as single points may be wrong.
constexpr double kHighest = 0.9;
constexpr int kPlaneRounds = 4;

/// The highest place of each cell, seen along the occlusal direction.
std::vector<Vec3> tops_of(const TriangleMesh& jaw, const Vec3& occlusal, const Vec3& right,
                          const Vec3& front) {
  std::map<std::pair<long, long>, Vec3> tops;
  for (const SurfacePoint& vertex : jaw.vertices) {
    const Vec3 p = vertex.position_mm.cast<double>();
    const auto cell = [&](const Vec3& axis) { return std::lround(axis.dot(p) / kTopCell_mm); };
    const auto [top, is_new] = tops.try_emplace({cell(right), cell(front)}, p);
    if (!is_new && occlusal.dot(p) > occlusal.dot(top->second)) top->second = p;
  }
  std::vector<Vec3> places;
  places.reserve(tops.size());
  for (const auto& [cell, place] : tops) places.push_back(place);
  return places;
}

/// Keeps the tops of teeth.
void keep_teeth(std::vector<Vec3>& tops, const Vec3& occlusal) {
  std::sort(tops.begin(), tops.end(),
            [&](const Vec3& a, const Vec3& b) { return occlusal.dot(a) < occlusal.dot(b); });
  const auto at = static_cast<std::size_t>(kHighest * static_cast<double>(tops.size() - 1));
  const double least = occlusal.dot(tops[at]) - kTeeth_mm;
  std::erase_if(tops, [&](const Vec3& p) { return occlusal.dot(p) < least; });
}

/// A plane, and how high it lies.
struct OcclusalPlane {
  Vec3 normal = Vec3::UnitZ();
  double height_mm = 0.0;
};

OcclusalPlane occlusal_plane(const TriangleMesh& jaw, const JawAxes& axes) {
  OcclusalPlane plane;
  plane.normal = axes.occlusal;
  for (int round = 0; round < kPlaneRounds; ++round) {
    const Vec3 right = axes.buccal.cross(plane.normal).normalized();
    const Vec3 front = plane.normal.cross(right);
    std::vector<Vec3> tops = tops_of(jaw, plane.normal, right, front);
    if (tops.empty()) return plane;
    keep_teeth(tops, plane.normal);
    Eigen::MatrixXd A(static_cast<Eigen::Index>(tops.size()), 3);
    Eigen::VectorXd heights(A.rows());
    for (Eigen::Index i = 0; i < A.rows(); ++i) {
      const Vec3& p = tops[static_cast<std::size_t>(i)];
      A.row(i) << right.dot(p), front.dot(p), 1.0;
      heights[i] = plane.normal.dot(p);
    }
    const LeastSquares fit = solve_least_squares(A, heights);
    if (fit.rank < 3) return plane;
    const Vec3 normal = plane.normal - fit.x[0] * right - fit.x[1] * front;
    plane.height_mm = fit.x[2] / normal.norm();
    plane.normal = normal.normalized();
  }
  return plane;
}

}  // namespace

Isometry T_patient_jaw(const TriangleMesh& jaw, JawKind kind) {
  const JawAxes axes = jaw_axes(jaw);
  const OcclusalPlane plane = occlusal_plane(jaw, axes);
  const Vec3 up = kind == JawKind::kLower ? plane.normal : Vec3(-plane.normal);
  const Vec3 back = -(axes.buccal - plane.normal * plane.normal.dot(axes.buccal)).normalized();
  Eigen::Matrix3d R;
  R << back.cross(up).transpose(), back.transpose(), up.transpose();
  const Vec3 middle = axes.box_mm.isEmpty()
                          ? Vec3::Zero()
                          : Vec3(axes.R_jaw_world().transpose() * axes.box_mm.center());
  const Vec3 origin = middle + (plane.height_mm - plane.normal.dot(middle)) * plane.normal;
  return make_isometry(Eigen::Quaterniond(R), -(R * origin));
}

}  // namespace flytri::occlusion
