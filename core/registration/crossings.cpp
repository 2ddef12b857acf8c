#include "core/registration/crossings.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace flytri::registration {
namespace {

/// Least uncertainty of a point, as a share of the view's median noise. Otherwise a point whose
/// deviation lies along the surface would count as exact.
constexpr double kNoiseFloor = 0.3;
/// Error of the splines between the points, as a share of the view's radius.
constexpr double kSplineError = 1e-4;

Vec3 at_nearest_knot(const std::vector<Vec3f>& values, double x) {
  const auto i = static_cast<std::size_t>(std::floor(x + 0.5));
  return values[std::min(i, values.size() - 1)].cast<double>();
}

Vec3 between_knots(const std::vector<Vec3f>& values, double x) {
  const std::size_t i = std::min(static_cast<std::size_t>(x), values.size() - 2);
  const auto w = static_cast<float>(x - static_cast<double>(i));
  return ((1.0F - w) * values[i] + w * values[i + 1]).cast<double>();
}

/// The two profiles of a pair, with their views.
struct Sides {
  const PreparedView& source;
  const PreparedView& target;
  const PreparedProfile& first;
  const PreparedProfile& second;

  Sides(const PreparedView& source_view, Metaview metaview, const ProfilePair& pair)
      : source(source_view),
        target(*metaview[pair.view]),
        first(source.profiles[pair.k]),
        second(target.profiles[pair.l]) {}
};

/// Standard uncertainty of the distance along the normal; nullopt if a measurement ray grazes the
/// surface.
std::optional<double> distance_sigma(const Sides& sides, const CurvePair& at, const Vec3& normal,
                                     const Isometry& T_moved, double min_ray_sine) {
  const Vec3 first = T_moved.linear() * at_nearest_knot(sides.first.deviations_mm, at.x);
  const Vec3 second = at_nearest_knot(sides.second.deviations_mm, at.y);
  const auto grazes = [&](const Vec3& deviation) {
    return std::abs(deviation.dot(normal)) < min_ray_sine * deviation.norm();
  };
  if (grazes(first) || grazes(second)) return std::nullopt;
  const double floor = kNoiseFloor * (sides.source.noise_mm + sides.target.noise_mm) +
                       kSplineError * sides.source.radius_mm;
  return std::hypot(first.dot(normal), second.dot(normal), floor);
}

std::optional<Crossing> measure(const Sides& sides, const ProfilePair& pair,
                                const Isometry& T_moved, const Vec2& start,
                                const CrossingLimits& limits) {
  const CurvePair at =
      refine_on_curves(sides.first.curve, sides.second.curve, T_moved, start.x(), start.y());
  if (!at.inside) return std::nullopt;
  const Vec3 gap = at.p.position_mm - at.q.position_mm;
  if (gap.squaredNorm() > limits.max_distance_mm * limits.max_distance_mm) return std::nullopt;
  const Vec3 o_k = T_moved.linear() * between_knots(sides.first.directions, at.x).normalized();
  const Vec3 o_l = between_knots(sides.second.directions, at.y).normalized();
  const Vec3 normal = o_k.cross(o_l);  // surface normal: paper, section "Calculation of Normals"
  const double sine = normal.norm();
  if (sine < limits.min_crossing_sine) return std::nullopt;

  Crossing crossing;
  crossing.pair = pair;
  crossing.x = at.x;
  crossing.y = at.y;
  crossing.p_mm = at.p.position_mm;
  crossing.q_mm = at.q.position_mm;
  crossing.normal = normal / sine;
  crossing.distance_mm = crossing.normal.dot(gap);
  const auto sigma_mm = distance_sigma(sides, at, crossing.normal, T_moved, limits.min_ray_sine);
  if (!sigma_mm) return std::nullopt;
  crossing.sigma_mm = *sigma_mm;
  crossing.depth_variation_mm = sides.first.depth_variation_mm + sides.second.depth_variation_mm;
  return crossing;
}

}  // namespace

std::vector<ProfilePair> candidate_pairs(const PreparedView& source, Metaview metaview,
                                         const CrossingLimits& limits) {
  const auto distance = static_cast<float>(limits.max_distance_mm * limits.max_distance_mm);
  const double max_cosine = std::sqrt(1.0 - limits.min_sheet_sine * limits.min_sheet_sine);
  std::vector<ProfilePair> pairs;
  for (std::uint32_t k = 0; k < source.profiles.size(); ++k) {
    const Box& box = source.profiles[k].tree.box();
    const Vec3& sheet = source.profiles[k].sheet_normal;
    for (std::uint32_t view = 0; view < metaview.size(); ++view) {
      const std::vector<PreparedProfile>& profiles = metaview[view]->profiles;
      for (std::uint32_t l = 0; l < profiles.size(); ++l) {
        if (box.squared_distance(profiles[l].tree.box()) > distance) continue;
        if (std::abs(sheet.dot(profiles[l].sheet_normal)) > max_cosine) continue;
        pairs.push_back({k, view, l});
      }
    }
  }
  return pairs;
}

void shuffle_front(std::vector<ProfilePair>& pairs, std::size_t count, Random& random) {
  for (std::size_t i = 0; i < std::min(count, pairs.size()); ++i) {
    std::swap(pairs[i], pairs[i + random.below(pairs.size() - i)]);
  }
}

std::vector<Crossing> find_crossings(const PreparedView& source, Metaview metaview,
                                     std::span<const ProfilePair> pairs,
                                     const CrossingLimits& limits) {
  std::vector<Crossing> crossings;
  crossings.reserve(pairs.size());
  for (const ProfilePair& pair : pairs) {
    const Sides sides(source, metaview, pair);
    const auto knots = closest_knots(sides.first, sides.second, limits.max_distance_mm);
    if (!knots) continue;
    const Vec2 start(static_cast<double>(knots->k), static_cast<double>(knots->l));
    if (auto crossing = measure(sides, pair, Isometry::Identity(), start, limits)) {
      crossings.push_back(*crossing);
    }
  }
  return crossings;
}

std::vector<Crossing> follow_crossings(const PreparedView& source, Metaview metaview,
                                       const Isometry& T_moved, std::span<const Crossing> crossings,
                                       const CrossingLimits& limits) {
  std::vector<Crossing> followed;
  followed.reserve(crossings.size());
  for (const Crossing& old : crossings) {
    const Sides sides(source, metaview, old.pair);
    if (auto crossing = measure(sides, old.pair, T_moved, {old.x, old.y}, limits)) {
      followed.push_back(*crossing);
    }
  }
  return followed;
}

}  // namespace flytri::registration
