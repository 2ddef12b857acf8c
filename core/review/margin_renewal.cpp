#include "core/review/margin_renewal.h"

#include <algorithm>
#include <limits>

namespace flytri::review {
namespace {

double to_nearest_mm(const Vec3& p_mm, const Polyline& line) {
  double least_mm = std::numeric_limits<double>::infinity();
  for (const MeasuredPoint& point : line.points)
    least_mm = std::min(least_mm, (point.position_mm - p_mm).norm());
  return least_mm;
}

/// Points are so close together that the nearest one stands for the line.
double farthest_mm(const Polyline& from, const Polyline& to) {
  double most_mm = 0.0;
  for (const MeasuredPoint& point : from.points)
    most_mm = std::max(most_mm, to_nearest_mm(point.position_mm, to));
  return most_mm;
}

}  // namespace

bool lies_on(const Polyline& line, const MeshDistance& surface) {
  return std::all_of(line.points.begin(), line.points.end(), [&](const MeasuredPoint& point) {
    return surface.is_within(point.position_mm.cast<float>(), kOnSurface_mm);
  });
}

std::optional<Margin> on_surface(const Margin& margin, std::span<const Vec3> clicks_mm,
                                 const TriangleMesh& mesh, const MeshDistance& distance,
                                 const Workers& workers) {
  if (lies_on(margin.line, distance)) return margin;
  auto anew = find_margin(mesh, clicks_mm, {}, workers);
  if (!anew) return std::nullopt;
  const bool is_where_it_was = farthest_mm(anew->line, margin.line) <= kMoved_mm &&
                               farthest_mm(margin.line, anew->line) <= kMoved_mm;
  return is_where_it_was ? std::optional(*std::move(anew)) : std::nullopt;
}

}  // namespace flytri::review
