#include "core/review/undercut.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "core/base/check_options.h"
#include "core/base/random.h"
#include "core/geometry/mesh_normals.h"
#include "core/meshing/mesh_topology.h"
#include "core/review/axis_view.h"

namespace flytri::review {
namespace {

/// A triangle is divided into at most the square of this many parts.
constexpr int kMaxDivisions = 200;
constexpr std::size_t kTrianglesPerTask = 256;

/// Each edge of a triangle is divided into so many.
int divisions_of(const TriangleMesh& mesh, const Triangle& t, double part_mm) {
  double longest_mm = 0.0;
  for (std::size_t k = 0; k < 3; ++k)
    longest_mm = std::max<double>(
        longest_mm,
        (mesh.vertices[t[k]].position_mm - mesh.vertices[t[(k + 1) % 3]].position_mm).norm());
  return static_cast<int>(std::clamp(std::ceil(longest_mm / part_mm), 1.0, double{kMaxDivisions}));
}

/// The share of a triangle's equal parts that is hidden in their middles.
float hidden_share_of(const AxisView& view, std::uint32_t triangle, int divisions) {
  int hidden = 0;
  for (int i = 0; i < divisions; ++i) {
    for (int j = 0; i + j < divisions; ++j) {
      // Two parts share an edge: one points up, and there is one that points down but at the end.
      for (const double middle : {1.0 / 3.0, 2.0 / 3.0}) {
        if (middle > 0.5 && i + j + 1 >= divisions) continue;
        const double a = (i + middle) / divisions, b = (j + middle) / divisions;
        hidden += view.is_hidden({triangle, {a, b, 1.0 - a - b}}) ? 1 : 0;
      }
    }
  }
  return static_cast<float>(hidden) / static_cast<float>(divisions * divisions);
}

std::vector<float> hidden_shares(const TriangleMesh& mesh, const AxisView& view, double part_mm,
                                 const Workers& workers) {
  std::vector<float> shares(mesh.triangles.size(), 0.0F);
  workers.for_each(
      shares.size(),
      [&](std::size_t t) {
        shares[t] = hidden_share_of(view, static_cast<std::uint32_t>(t),
                                    divisions_of(mesh, mesh.triangles[t], part_mm));
      },
      kTrianglesPerTask);
  return shares;
}

double weighted_area_mm2(const TriangleMesh& mesh, const std::vector<float>& shares) {
  double area_mm2 = 0.0;
  for (std::size_t t = 0; t < shares.size(); ++t) {
    if (shares[t] > 0.0F) area_mm2 += shares[t] * area_vector_mm2(mesh, mesh.triangles[t]).norm();
  }
  return area_mm2;
}

/// Steps on the grid within a radius, the nearest first.
std::vector<std::array<int, 2>> steps_within(int radius) {
  std::vector<std::array<int, 2>> steps;
  const auto squared = [](const std::array<int, 2>& s) { return s[0] * s[0] + s[1] * s[1]; };
  for (int y = -radius; y <= radius; ++y)
    for (int x = -radius; x <= radius; ++x)
      if (squared({x, y}) <= radius * radius) steps.push_back({x, y});
  std::stable_sort(steps.begin(), steps.end(),
                   [&](const auto& a, const auto& b) { return squared(a) < squared(b); });
  return steps;
}

/// How deep the middles of hidden triangles are. On average the middle of the nearest free cell
/// lies half a step behind the border of the free place.
std::vector<float> depths_mm(const AxisView& view, const std::vector<float>& shares,
                             const UndercutOptions& options, const Workers& workers) {
  const AxisView::HeightMap map = view.height_map(options.depth_step_mm);
  const auto steps = steps_within(static_cast<int>(std::ceil(options.max_depth_mm / map.step_mm)));
  std::vector<float> depths(shares.size(), 0.0F);
  const auto depth_of = [&](std::size_t t) -> double {
    const Vec3 p_mm = view.position_mm({static_cast<std::uint32_t>(t)});
    const Vec2 at = (p_mm.head<2>() - map.low_mm) / map.step_mm;
    const auto column = static_cast<int>(std::floor(at.x()));
    const auto row = static_cast<int>(std::floor(at.y()));
    for (const auto& step : steps) {
      if (!map.is_free(column + step[0], row + step[1], p_mm.z() + 1e-3)) continue;
      const Vec2 free(column + step[0] + 0.5, row + step[1] + 0.5);
      return std::clamp((free - at).norm() - 0.5, 0.0, options.max_depth_mm / map.step_mm) *
             map.step_mm;
    }
    return options.max_depth_mm;
  };
  workers.for_each(
      shares.size(),
      [&](std::size_t t) {
        if (shares[t] > 0.0F) depths[t] = static_cast<float>(depth_of(t));
      },
      kTrianglesPerTask);
  return depths;
}

TriangleMesh with_other_noise(const TriangleMesh& mesh, std::uint64_t seed) {
  TriangleMesh moved = mesh;
  for (std::size_t i = 0; i < moved.vertices.size(); ++i) {
    SurfacePoint& vertex = moved.vertices[i];
    const double error_mm = Random(seed, i).normal() * static_cast<double>(vertex.sigma_mm);
    vertex.position_mm += static_cast<float>(error_mm) * vertex.normal;
  }
  return moved;
}

double area_uncertainty_mm2(const TriangleMesh& mesh, const Vec3& axis, double area_mm2,
                            const UndercutOptions& options, const Workers& workers) {
  bool has_noise = false;
  for (const SurfacePoint& vertex : mesh.vertices) {
    if (!std::isfinite(vertex.sigma_mm)) return std::numeric_limits<double>::infinity();
    has_noise = has_noise || vertex.sigma_mm > 0.0F;
  }
  if (!has_noise) return 0.0;
  double sum = 0.0;
  for (int copy = 1; copy <= options.noise_copies; ++copy) {
    const TriangleMesh moved = with_other_noise(mesh, static_cast<std::uint64_t>(copy));
    const AxisView view(moved, axis);
    const double change_mm2 =
        weighted_area_mm2(moved, hidden_shares(moved, view, options.part_mm, workers)) - area_mm2;
    sum += change_mm2 * change_mm2;
  }
  return std::sqrt(sum / options.noise_copies);
}

}  // namespace

Result<TriangleMesh> part_around(const TriangleMesh& mesh, const Vec3& center_mm,
                                 double radius_mm) {
  if (!(radius_mm > 0.0))
    return fail(ErrorCode::kBadOption, "the radius is {} mm, but must be above 0", radius_mm);
  std::vector<char> keep;
  keep.reserve(mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) {
    Vec3f middle_mm = Vec3f::Zero();
    for (const std::uint32_t v : t) middle_mm += mesh.vertices[v].position_mm / 3.0F;
    keep.push_back((middle_mm.cast<double>() - center_mm).norm() <= radius_mm ? 1 : 0);
  }
  if (std::none_of(keep.begin(), keep.end(), [](char kept) { return kept != 0; }))
    return fail(ErrorCode::kInsufficient,
                "the model has no surface within {} mm of ({:.3f}, {:.3f}, {:.3f}) mm; choose a "
                "point on it, or a larger radius",
                radius_mm, center_mm.x(), center_mm.y(), center_mm.z());
  TriangleMesh part = mesh;
  meshing::keep_triangles(part, keep);
  meshing::drop_unused_vertices(part);
  return part;
}

Result<void> UndercutOptions::validate() const {
  return OptionCheck("UndercutOptions")
      .positive("part_mm", part_mm)
      .positive("depth_step_mm", depth_step_mm)
      .positive_up_to("max_depth_mm", max_depth_mm, 1e3 * depth_step_mm)
      .at_least("noise_copies", noise_copies, 2)
      .result();
}

double Undercut::area_deeper_mm2(const TriangleMesh& mesh, double least_mm) const {
  double sum_mm2 = 0.0;
  for (std::size_t t = 0; t < hidden_share.size(); ++t) {
    if (hidden_share[t] > 0.0F && depth_mm[t] >= least_mm)
      sum_mm2 += hidden_share[t] * area_vector_mm2(mesh, mesh.triangles[t]).norm();
  }
  return sum_mm2;
}

Result<Undercut> find_undercut(const TriangleMesh& mesh, const Vec3& axis,
                               const UndercutOptions& options, const Workers& workers) {
  if (auto valid = options.validate(); !valid) return tl::unexpected(valid.error());
  if (!axis.allFinite() || !(axis.norm() > 0.0))
    return fail(ErrorCode::kBadOption,
                "the insertion axis has no direction; give numbers that are not all 0");
  if (mesh.triangles.empty())
    return fail(ErrorCode::kInsufficient, "the surface has no triangles; choose a larger part");
  const Vec3 direction = axis.normalized();
  const AxisView view(mesh, direction);
  Undercut undercut;
  undercut.hidden_share = hidden_shares(mesh, view, options.part_mm, workers);
  undercut.depth_mm = depths_mm(view, undercut.hidden_share, options, workers);
  undercut.deepest_mm = *std::max_element(undercut.depth_mm.begin(), undercut.depth_mm.end());
  undercut.surface_mm2 = weighted_area_mm2(mesh, std::vector<float>(mesh.triangles.size(), 1.0F));
  undercut.area_mm2.value = weighted_area_mm2(mesh, undercut.hidden_share);
  undercut.area_mm2.uncertainty =
      area_uncertainty_mm2(mesh, direction, undercut.area_mm2.value, options, workers);
  return undercut;
}

}  // namespace flytri::review
