#include "core/review/insertion_axis.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/base/check_options.h"
#include "core/geometry/mesh_normals.h"
#include "core/review/axis_view.h"

namespace flytri::review {
namespace {

/// Steps between axes: over the cone, then around the best ones, rad.
constexpr std::array kSteps_rad = {0.0873, 0.0291, 0.0087};

/// Surface that leans back by this counts in full, rad.
constexpr double kFullLean_rad = 0.02;

/// Directions on rings around `middle`, up to `cone_rad` from it.
std::vector<Vec3> axes_around(const Vec3& middle, double cone_rad, double step_rad) {
  const Vec3 u = middle.unitOrthogonal(), v = middle.cross(u);
  std::vector<Vec3> axes = {middle};
  const int rings = static_cast<int>(std::floor(cone_rad / step_rad + 1e-9));
  for (int ring = 1; ring <= rings; ++ring) {
    const double tilt = ring * step_rad;
    const auto count =
        static_cast<int>(std::ceil(2.0 * std::numbers::pi * std::sin(tilt) / step_rad));
    for (int i = 0; i < count; ++i) {
      const double turn = 2.0 * std::numbers::pi * i / count;
      axes.push_back(std::cos(tilt) * middle +
                     std::sin(tilt) * (std::cos(turn) * u + std::sin(turn) * v));
    }
  }
  return axes;
}

struct AxisCost {
  double area_mm2 = 0.0;  ///< hidden
  double cost_mm2 = 0.0;
};

/// The smallest tilt hides half of a cylinder. So surface that leans back a little counts little,
/// and each hidden triangle also counts by the area that the viewer sees: a larger tilt costs more.
AxisCost cost_of(const TriangleMesh& mesh, const Vec3& axis) {
  const AxisView view(mesh, axis);
  AxisCost sum;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!view.is_hidden({t})) continue;
    const Vec3 vector_mm2 = area_vector_mm2(mesh, mesh.triangles[t]);
    const double area_mm2 = vector_mm2.norm(), seen_mm2 = vector_mm2.dot(axis);
    const double counted = std::clamp(-seen_mm2 / (kFullLean_rad * area_mm2 + 1e-12), 0.0, 1.0);
    sum.area_mm2 += area_mm2;
    sum.cost_mm2 += area_mm2 * (seen_mm2 < 0.0 ? counted : 1.0) + std::abs(seen_mm2);
  }
  return sum;
}

/// The best of some axes: the middle of those that are as good as the best one.
InsertionAxis best_of(const TriangleMesh& mesh, const std::vector<Vec3>& axes, double equal_mm2,
                      const Workers& workers) {
  std::vector<double> costs_mm2(axes.size());
  workers.for_each(axes.size(),
                   [&](std::size_t i) { costs_mm2[i] = cost_of(mesh, axes[i]).cost_mm2; });
  const auto least = std::min_element(costs_mm2.begin(), costs_mm2.end());
  std::vector<Vec3> equals;
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if (costs_mm2[i] > *least + equal_mm2) continue;
    equals.push_back(axes[i]);
    sum += axes[i];
  }
  InsertionAxis best{sum.normalized(), 0.0, 0.0};
  // The good axes may lie around worse ones.
  if (cost_of(mesh, best.axis).cost_mm2 > *least + equal_mm2)
    best.axis = axes[static_cast<std::size_t>(least - costs_mm2.begin())];
  best.undercut_mm2 = cost_of(mesh, best.axis).area_mm2;
  for (const Vec3& axis : equals)
    best.equal_within_rad = std::max(best.equal_within_rad,
                                     std::atan2(axis.cross(best.axis).norm(), axis.dot(best.axis)));
  return best;
}

}  // namespace

Result<void> AxisOptions::validate() const {
  return OptionCheck("AxisOptions")
      .positive_up_to("cone_rad", cone_rad, 1.4)
      .not_negative("equal_share", equal_share)
      .result();
}

Vec3 mean_normal(const TriangleMesh& mesh) {
  Vec3 sum = Vec3::Zero();
  double area_mm2 = 0.0;
  for (const Triangle& triangle : mesh.triangles) {
    const Vec3 vector_mm2 = area_vector_mm2(mesh, triangle);
    sum += vector_mm2;
    area_mm2 += vector_mm2.norm();
  }
  return sum.norm() > 1e-3 * area_mm2 ? Vec3(sum.normalized()) : Vec3(Vec3::Zero());
}

Result<InsertionAxis> find_insertion_axis(const TriangleMesh& mesh, const Vec3& start,
                                          const AxisOptions& options, const Workers& workers) {
  if (auto valid = options.validate(); !valid) return tl::unexpected(valid.error());
  if (mesh.triangles.empty())
    return fail(ErrorCode::kInsufficient, "the surface has no triangles; choose a larger part");
  if (!start.allFinite() || !(start.norm() > 0.0))
    return fail(ErrorCode::kBadOption,
                "the surface shows no side to insert from, as it is closed; give an axis");
  double surface_mm2 = 0.0;
  for (const Triangle& triangle : mesh.triangles)
    surface_mm2 += area_vector_mm2(mesh, triangle).norm();
  const double equal_mm2 = options.equal_share * surface_mm2;
  InsertionAxis best{start.normalized(), 0.0, options.cone_rad};
  double found_within_rad = 0.0;
  double cone_rad = options.cone_rad;
  for (const double step_rad : kSteps_rad) {
    best = best_of(mesh, axes_around(best.axis, cone_rad, step_rad), equal_mm2, workers);
    found_within_rad = std::max(found_within_rad, best.equal_within_rad);
    cone_rad = step_rad;
  }
  best.equal_within_rad = found_within_rad;
  return best;
}

}  // namespace flytri::review
