#include "core/meshing/implicit_surface.h"

#include <algorithm>
#include <cmath>

#include "core/base/square.h"
#include "core/geometry/decompositions.h"

namespace flytri::meshing {
namespace {

constexpr std::size_t kMinNeighbors = 3;
/// At a straight border of the surface, the centroid of the half disk of points is 0.42 radii away.
/// A little farther counts as outside.
constexpr float kMaxCentroidShare = 0.45F;

/// Least squared ratio of width to length of the points around a place; a full disk has 1.
constexpr float kMinWidthShare = 0.03F;

/// Far from points, the width of the Gaussian is this share of the distance to the nearest point.
constexpr float kSigmaOfDistance = 0.5F;

/// A gap is closed only if, seen from inside, no angle wider than kMaxEmptyAngle is without points,
/// and if kSmoothShare of the points around it have similar normals (cosine at least
/// kMinSmoothCosine) and are near the tangent plane (within kMaxSmoothOffset gap radii). So the gap
/// between two teeth that almost touch stays open.
constexpr float kMaxEmptyAngle = 2.1F;
constexpr float kSmoothShare = 0.9F;
constexpr float kMinSmoothCosine = 0.8F;
constexpr float kMaxSmoothOffset = 0.2F;

std::vector<Vec3f> positions_of(const PointCloud& points) {
  std::vector<Vec3f> positions;
  positions.reserve(points.size());
  for (const SurfacePoint& point : points) positions.push_back(point.position_mm);
  return positions;
}

}  // namespace

ImplicitSurface::ImplicitSurface(const PointCloud& points, float sigma_mm, float reach_mm,
                                 float gap_mm)
    : points_(points),
      sigma_mm_(sigma_mm),
      reach_mm_(reach_mm),
      gap_mm_(gap_mm),
      grid_(positions_of(points), reach_mm) {}

/// Calls visit(point, weight) for the points that tell the surface at a place.
/// @returns false if they are too few
template <typename Visit>
bool SurfaceProbe::weigh(const Vec3f& place_mm, const Visit& visit) {
  std::span<const Neighbor> found = near_.within(place_mm, surface_.reach_mm_);
  if (found.size() < kMinNeighbors) found = near_.within(place_mm, surface_.gap_mm_);
  if (found.size() < kMinNeighbors) return false;
  const auto nearest =
      std::min_element(found.begin(), found.end(), [](const auto& a, const auto& b) {
        return std::pair(a.distance2_mm2, a.index) < std::pair(b.distance2_mm2, b.index);
      });
  const PointCloud& points = surface_.points_;
  const Vec3f& facing = points[nearest->index].normal;
  const float sigma2_mm2 =
      std::max(square(surface_.sigma_mm_), square(kSigmaOfDistance) * nearest->distance2_mm2);
  for (const Neighbor& neighbor : found) {
    const SurfacePoint& point = points[neighbor.index];
    // Ignore the other side of a thin wall.
    if (point.normal.dot(facing) <= 0.0F) continue;
    // Relative to the nearest point, so that exp() does not underflow far from points.
    visit(point, std::exp(-0.5F * (neighbor.distance2_mm2 - nearest->distance2_mm2) / sigma2_mm2));
  }
  return true;
}

std::optional<float> SurfaceProbe::distance_mm(const Vec3f& place_mm) {
  float sum_mm = 0.0F, sum_w = 0.0F;
  const bool is_known = weigh(place_mm, [&](const SurfacePoint& point, float w) {
    sum_w += w;
    sum_mm += w * point.normal.dot(place_mm - point.position_mm);
  });
  if (!is_known) return std::nullopt;
  return sum_mm / sum_w;
}

std::optional<Vec3f> SurfaceProbe::offset_mm(const Vec3f& place_mm) {
  float sum_mm = 0.0F, sum_w = 0.0F;
  Vec3f normal = Vec3f::Zero();
  const bool is_known = weigh(place_mm, [&](const SurfacePoint& point, float w) {
    sum_w += w;
    sum_mm += w * point.normal.dot(place_mm - point.position_mm);
    normal += w * point.normal;
  });
  if (!is_known) return std::nullopt;
  return Vec3f(sum_mm / sum_w * normal.normalized());
}

std::optional<SurfaceEstimate> SurfaceProbe::at(const Vec3f& place_mm) {
  SurfaceEstimate sum;
  sum.mean.position_mm = sum.mean.normal = Vec3f::Zero();
  Vec3f color = Vec3f::Zero();
  float sum_w = 0.0F;
  const bool is_known = weigh(place_mm, [&](const SurfacePoint& point, float w) {
    sum_w += w;
    sum.distance_mm += w * point.normal.dot(place_mm - point.position_mm);
    sum.mean.position_mm += w * point.position_mm;
    sum.mean.normal += w * point.normal;
    sum.mean.sigma_mm += w * point.sigma_mm;
    sum.mean.patterns |= point.patterns;
    for (int c = 0; c < 3; ++c) color[c] += w * static_cast<float>(point.color[c]);
  });
  if (!is_known) return std::nullopt;
  sum.distance_mm /= sum_w;
  sum.mean.position_mm /= sum_w;
  sum.mean.normal.normalize();
  sum.mean.sigma_mm /= sum_w;
  for (int c = 0; c < 3; ++c) {
    sum.mean.color[c] = static_cast<std::uint8_t>(std::lround(color[c] / sum_w));
  }
  return sum;
}

bool SurfaceProbe::surrounded(const Vec3f& place_mm, const Vec3f& normal) {
  return surrounded_closely(place_mm, normal) || in_smooth_gap(place_mm, normal);
}

bool SurfaceProbe::surrounded_closely(const Vec3f& place_mm, const Vec3f& normal) {
  const std::span<const Neighbor> found = near_.within(place_mm, surface_.reach_mm_);
  Vec3f centroid = Vec3f::Zero();
  Eigen::Matrix3f spread = Eigen::Matrix3f::Zero();
  float count = 0.0F;
  for (const Neighbor& neighbor : found) {
    if (surface_.points_[neighbor.index].normal.dot(normal) <= 0.0F) continue;
    const Vec3f offset = surface_.points_[neighbor.index].position_mm - place_mm;
    centroid += offset;
    spread += offset * offset.transpose();
    count += 1.0F;
  }
  if (count < static_cast<float>(kMinNeighbors)) return false;
  centroid /= count;
  // A ridge or groove moves the centroid along the normal; this is not a border.
  centroid -= centroid.dot(normal) * normal;
  if (centroid.norm() > kMaxCentroidShare * surface_.reach_mm_) return false;
  // A single line of points has no width and is not a surface.
  const Vec3f widths = symmetric_eigenvalues(spread);
  return widths[1] >= kMinWidthShare * widths[2];
}

bool SurfaceProbe::in_smooth_gap(const Vec3f& place_mm, const Vec3f& normal) {
  const std::span<const Neighbor> found = near_.within(place_mm, surface_.gap_mm_);
  const Vec3f across = normal.unitOrthogonal();
  const Vec3f along = normal.cross(across);
  angles_.clear();
  for (const Neighbor& neighbor : found) {
    const SurfacePoint& point = surface_.points_[neighbor.index];
    const Vec3f offset = point.position_mm - place_mm;
    if (point.normal.dot(normal) < kMinSmoothCosine) continue;
    if (std::abs(offset.dot(normal)) > kMaxSmoothOffset * surface_.gap_mm_) continue;
    angles_.push_back(std::atan2(offset.dot(along), offset.dot(across)));
  }
  if (angles_.size() < kMinNeighbors ||
      static_cast<float>(angles_.size()) < kSmoothShare * static_cast<float>(found.size())) {
    return false;
  }
  std::sort(angles_.begin(), angles_.end());
  float widest = angles_.front() + 2.0F * static_cast<float>(M_PI) - angles_.back();
  for (std::size_t i = 1; i < angles_.size(); ++i) {
    widest = std::max(widest, angles_[i] - angles_[i - 1]);
  }
  return widest < kMaxEmptyAngle;
}

}  // namespace flytri::meshing
