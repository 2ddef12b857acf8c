#include "core/review/margin.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/base/check_options.h"
#include "core/review/closed_line.h"

namespace flytri::review {
namespace {

/// Each round starts nearer to the edge, so that the gap around it is left out in the right place.
constexpr int kRounds = 5;
/// Smoothing of the path over mesh vertices, which is jagged by a triangle.
constexpr double kPathSmooth_mm = 0.5;
constexpr double kPathOutlier_mm = 1.0;
/// Below this share of edge, the line is made up.
constexpr double kLeastEdgeShare = 0.5;

/// A line, and what was found at its points.
struct FittedLine {
  std::vector<Vec3> places_mm;
  std::vector<std::optional<EdgeSurface::Edge>> edges;  ///< none: no edge there
};

int steps_in(double length_mm, double step_mm) {
  return std::max(1, static_cast<int>(std::lround(length_mm / step_mm)));
}

std::vector<Vec3> start_line(const TriangleMesh& mesh, const std::vector<std::uint32_t>& path,
                             double step_mm) {
  std::vector<Vec3> line_mm;
  line_mm.reserve(path.size());
  for (const std::uint32_t vertex : path)
    line_mm.push_back(mesh.vertices[vertex].position_mm.cast<double>());
  line_mm = evenly_spaced(line_mm, step_mm);
  return smoothed(line_mm, std::vector<double>(line_mm.size(), 1.0),
                  steps_in(kPathSmooth_mm, step_mm), kPathOutlier_mm);
}

/// One round: fits the edge at each point, smooths, spaces evenly.
FittedLine fit_line(const EdgeSurface& surface, std::vector<Vec3> line_mm,
                    const MarginOptions& options, const Workers& workers) {
  const int reach = steps_in(options.smooth_mm, options.step_mm);
  const std::vector<Vec3> along = directions(line_mm, std::max(1, reach / 2));
  FittedLine fitted;
  fitted.edges.resize(line_mm.size());
  workers.for_each(
      line_mm.size(), [&](std::size_t i) { fitted.edges[i] = surface.fit(line_mm[i], along[i]); },
      8);
  std::vector<double> weights(line_mm.size(), 0.0);
  for (std::size_t i = 0; i < line_mm.size(); ++i) {
    if (!fitted.edges[i]) continue;
    line_mm[i] = fitted.edges[i]->place_mm;
    weights[i] = 1.0 / (1e-6 + fitted.edges[i]->sigma_mm * fitted.edges[i]->sigma_mm);
  }
  fitted.places_mm = smoothed(line_mm, weights, reach, options.outlier_mm);
  return fitted;
}

/// Lays the points on the surface; those without an edge have no known uncertainty.
Margin margin_of(const TriangleMesh& mesh, const FittedLine& fitted) {
  const MeshDistance distance(mesh);
  Margin margin;
  margin.line.is_closed = true;
  margin.least_turn_rad = std::numeric_limits<double>::infinity();
  std::size_t edges = 0;
  for (std::size_t i = 0; i < fitted.places_mm.size(); ++i) {
    MeasuredPoint point = point_on_surface(mesh, distance, fitted.places_mm[i]);
    point.sigma_mm = std::numeric_limits<double>::infinity();
    if (const auto& edge = fitted.edges[i]) {
      ++edges;
      point.sigma_mm = edge->sigma_mm;
      margin.least_turn_rad = std::min(margin.least_turn_rad, edge->turn_rad);
    }
    margin.line.points.push_back(point);
  }
  margin.edge_share = static_cast<double>(edges) / static_cast<double>(fitted.places_mm.size());
  return margin;
}

}  // namespace

Result<void> MarginOptions::validate() const {
  return OptionCheck("MarginOptions")
      .nested(path)
      .nested(fit)
      .positive("step_mm", step_mm)
      .at_least("smooth_mm", smooth_mm, step_mm)
      .positive("outlier_mm", outlier_mm)
      .result();
}

Result<Margin> find_margin(const TriangleMesh& mesh, std::span<const Vec3> clicks_mm,
                           const MarginOptions& options, const Workers& workers) {
  if (auto valid = options.validate(); !valid) return tl::unexpected(valid.error());
  const auto path = edge_path(mesh, clicks_mm, options.path);
  if (!path) return tl::unexpected(path.error());
  std::vector<Vec3> line_mm = start_line(mesh, *path, options.step_mm);
  const EdgeSurface surface(mesh, line_mm, options.fit);
  FittedLine fitted;
  for (int round = 0; round < kRounds; ++round) {
    fitted = fit_line(surface, line_mm, options, workers);
    line_mm = evenly_spaced(fitted.places_mm, options.step_mm);
  }
  Margin margin = margin_of(mesh, fitted);
  if (margin.edge_share >= kLeastEdgeShare) return margin;
  return fail(ErrorCode::kInsufficient,
              "only {:.0f} % of the margin line is on an edge of the surface; choose more points "
              "along the edge, or scan the margin again",
              100.0 * margin.edge_share);
}

}  // namespace flytri::review
