#include "core/evaluation/surface_error.h"

#include <algorithm>
#include <cmath>

#include "core/base/check_options.h"
#include "core/base/median.h"
#include "core/geometry/mesh_distance.h"
#include "core/geometry/point_grid.h"

namespace flytri::evaluation {
namespace {

// Queries per task of the parallel loops; a query takes about 1 µs.
constexpr std::size_t kQueryGrain = 1024;

// Each vertex as a degenerate triangle, so that MeshDistance also works for points.
TriangleMesh vertices_alone(const TriangleMesh& mesh) {
  TriangleMesh points;
  points.vertices = mesh.vertices;
  for (std::uint32_t i = 0; i < mesh.vertices.size(); ++i) points.triangles.push_back({i, i, i});
  return points;
}

std::vector<std::uint32_t> selected_indices(const TriangleMesh& truth,
                                            const std::vector<bool>& selected) {
  std::vector<std::uint32_t> indices;
  for (std::uint32_t i = 0; i < truth.vertices.size(); ++i)
    if (selected.empty() || selected[i]) indices.push_back(i);
  return indices;
}

double share_within(const MeshDistance& target, const TriangleMesh& truth,
                    const std::vector<std::uint32_t>& indices, double within_mm,
                    const Workers& workers) {
  if (indices.empty()) return 0.0;
  std::vector<char> found(indices.size(), 0);
  workers.for_each(
      indices.size(),
      [&](std::size_t i) {
        const Vec3f& p = truth.vertices[indices[i]].position_mm;
        found[i] = std::isfinite(target.closest(p, within_mm).distance_mm) ? 1 : 0;
      },
      kQueryGrain);
  return static_cast<double>(std::count(found.begin(), found.end(), 1)) /
         static_cast<double>(indices.size());
}

std::vector<Vec3f> points_of(const std::vector<AlignedView>& views, Pattern pattern) {
  std::vector<Vec3f> points_mm;
  for (const AlignedView& aligned : views) {
    if (aligned.view->pattern != pattern) continue;
    for (const Profile& profile : aligned.view->profiles) {
      for (const ProfilePoint& point : profile.points)
        points_mm.push_back((aligned.T_world_sensor * point.position_mm).cast<float>());
    }
  }
  return points_mm;
}

double share_above(const std::vector<double>& values, double threshold) {
  const auto above = std::count_if(values.begin(), values.end(),
                                   [threshold](double value) { return value > threshold; });
  return static_cast<double>(above) / static_cast<double>(values.size());
}

}  // namespace

DistanceStatistics distance_statistics(std::vector<double> distances_mm) {
  DistanceStatistics statistics;
  if (distances_mm.empty()) return statistics;
  std::sort(distances_mm.begin(), distances_mm.end());
  double sum = 0.0;
  double sum_of_squares = 0.0;
  for (const double distance : distances_mm) {
    sum += distance;
    sum_of_squares += distance * distance;
  }
  const auto count = static_cast<double>(distances_mm.size());
  statistics.count = static_cast<std::int64_t>(distances_mm.size());
  statistics.rms_mm = std::sqrt(sum_of_squares / count);
  statistics.mean_mm = sum / count;
  statistics.median_mm = quantile_of(distances_mm, 0.5);
  statistics.percentile_95_mm = quantile_of(distances_mm, 0.95);
  statistics.max_mm = distances_mm.back();
  return statistics;
}

Result<void> SurfaceErrorOptions::validate() const {
  return OptionCheck("SurfaceErrorOptions")
      .positive("complete_within_mm", complete_within_mm)
      .positive("far_above_mm", far_above_mm)
      .result();
}

std::vector<bool> crossed_vertices(const TriangleMesh& truth, const std::vector<AlignedView>& views,
                                   double within_mm, const Workers& workers) {
  const auto reach_mm = static_cast<float>(within_mm);
  std::vector<bool> is_crossed(truth.vertices.size(), true);
  for (const Pattern pattern : kPatterns) {
    const PointGrid measured(points_of(views, pattern), reach_mm);
    std::vector<char> is_near(is_crossed.size());
    workers.for_each(
        is_near.size(),
        [&](std::size_t i) {
          is_near[i] = measured.nearest(truth.vertices[i].position_mm, reach_mm) ? 1 : 0;
        },
        kQueryGrain);
    for (std::size_t i = 0; i < is_near.size(); ++i) {
      if (is_near[i] == 0) is_crossed[i] = false;
    }
  }
  return is_crossed;
}

Completeness completeness(const TriangleMesh& result, const TriangleMesh& truth,
                          const std::vector<bool>& selected, double within_mm,
                          const Workers& workers) {
  const std::vector<std::uint32_t> indices = selected_indices(truth, selected);
  return {static_cast<std::int64_t>(indices.size()),
          share_within(MeshDistance(result), truth, indices, within_mm, workers),
          share_within(MeshDistance(vertices_alone(result)), truth, indices, within_mm, workers)};
}

Result<SurfaceError> surface_error(const TriangleMesh& result, const TriangleMesh& truth,
                                   const std::vector<bool>& selected,
                                   const SurfaceErrorOptions& options, const Workers& workers) {
  if (auto valid = options.validate(); !valid) return tl::unexpected(valid.error());
  if (result.vertices.empty() || truth.triangles.empty())
    return fail(ErrorCode::kInsufficient, "the {} is empty: no surface to compare",
                result.vertices.empty() ? "result" : "true mesh");
  if (!selected.empty() && selected.size() != truth.vertices.size())
    return fail(ErrorCode::kInconsistent,
                "{} selected flags for {} true vertices; the numbers must be equal",
                selected.size(), truth.vertices.size());
  const MeshDistance to_truth(truth);
  std::vector<double> distances_mm(result.vertices.size());
  workers.for_each(
      distances_mm.size(),
      [&](std::size_t i) {
        distances_mm[i] = to_truth.closest(result.vertices[i].position_mm).distance_mm;
      },
      kQueryGrain);
  SurfaceError error;
  error.far_share = share_above(distances_mm, options.far_above_mm);
  error.distance = distance_statistics(std::move(distances_mm));

  error.completeness = completeness(result, truth, selected, options.complete_within_mm, workers);
  return error;
}

TriangleMesh transformed(const TriangleMesh& mesh, const Isometry& T_to_from) {
  TriangleMesh moved = mesh;
  for (SurfacePoint& vertex : moved.vertices) {
    vertex.position_mm = (T_to_from * vertex.position_mm.cast<double>()).cast<float>();
    vertex.normal = (T_to_from.linear() * vertex.normal.cast<double>()).cast<float>();
  }
  return moved;
}

}  // namespace flytri::evaluation
