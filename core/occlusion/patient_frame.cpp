#include "core/occlusion/patient_frame.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
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

/// The frame of a jaw with this plane.
Isometry frame_of(const JawAxes& axes, const OcclusalPlane& plane, JawKind kind) {
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

constexpr auto kWhichPoints = "click the cusps of the last molars and the edge of the incisors";

/// A click is a fraction of a millimeter off: this near, it would turn the plane by degrees.
Result<void> check_distances(const OcclusalPoints& points) {
  constexpr double kLeast_mm = 5.0, kLeastHeight_mm = 4.0;
  double longest_mm = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::size_t next = (i + 1) % points.size();
    const double apart_mm = (points[next] - points[i]).norm();
    longest_mm = std::max(longest_mm, apart_mm);
    if (apart_mm >= kLeast_mm) continue;
    return fail(ErrorCode::kInconsistent,
                "points {} and {} are {:.1f} mm apart, at least {:.0f} mm are needed; {}",
                std::min(i, next) + 1, std::max(i, next) + 1, apart_mm, kLeast_mm, kWhichPoints);
  }
  const double height_mm = (points[1] - points[0]).cross(points[2] - points[0]).norm() / longest_mm;
  if (height_mm >= kLeastHeight_mm) return {};
  return fail(ErrorCode::kInconsistent,
              "the points lie nearly on a line: one is {:.1f} mm beside the other two, at least "
              "{:.0f} mm are needed; {}",
              height_mm, kLeastHeight_mm, kWhichPoints);
}

/// Share of the jaw on the side of the opposing teeth.
double share_beyond(const TriangleMesh& jaw, const OcclusalPlane& plane) {
  if (jaw.vertices.empty()) return 0.0;
  const auto beyond =
      std::count_if(jaw.vertices.begin(), jaw.vertices.end(), [&](const SurfacePoint& vertex) {
        return plane.normal.dot(vertex.position_mm.cast<double>()) > plane.height_mm;
      });
  return static_cast<double>(beyond) / static_cast<double>(jaw.vertices.size());
}

Result<OcclusalPlane> plane_through(const OcclusalPoints& points, const JawAxes& axes) {
  constexpr double kMostTilt_deg = 40.0;
  if (auto apart = check_distances(points); !apart) return tl::unexpected(apart.error());
  OcclusalPlane plane;
  plane.normal = (points[1] - points[0]).cross(points[2] - points[0]).normalized();
  if (plane.normal.dot(axes.occlusal) < 0.0) plane.normal = -plane.normal;
  plane.height_mm = plane.normal.dot(points[0]);
  const double tilt_deg =
      std::acos(std::min(plane.normal.dot(axes.occlusal), 1.0)) * 180.0 / std::numbers::pi;
  if (tilt_deg <= kMostTilt_deg) return plane;
  return fail(ErrorCode::kInconsistent,
              "the plane would stand at {:.0f} degrees to the chewing surfaces, at most {:.0f} are "
              "possible; {}",
              tilt_deg, kMostTilt_deg, kWhichPoints);
}

}  // namespace

Isometry T_patient_jaw(const TriangleMesh& jaw, JawKind kind) {
  const JawAxes axes = jaw_axes(jaw);
  return frame_of(axes, occlusal_plane(jaw, axes), kind);
}

Result<Isometry> T_patient_jaw(const TriangleMesh& jaw, JawKind kind,
                               const OcclusalPoints& points) {
  constexpr double kMostBeyond = 0.5;
  const JawAxes axes = jaw_axes(jaw);
  const auto plane = plane_through(points, axes);
  if (!plane) return tl::unexpected(plane.error());
  const double beyond = share_beyond(jaw, *plane);
  if (beyond <= kMostBeyond) return frame_of(axes, *plane, kind);
  return fail(ErrorCode::kInconsistent,
              "{:.0f} % of the jaw would lie beyond the plane, so that the points are not on the "
              "chewing surfaces; {}",
              100.0 * beyond, kWhichPoints);
}

}  // namespace flytri::occlusion
