#include "core/occlusion/place_bite.h"

#include <algorithm>
#include <cmath>

#include "core/geometry/decompositions.h"
#include "core/tracking/pose_search.h"

namespace flytri::occlusion {
namespace {

/// Radius of the parts of the bite that are searched, about that of a view: a part holds one or two
/// teeth of a jaw.
constexpr double kPartRadius_mm = 7.0;
constexpr std::size_t kParts = 8, kGuessesByPart = 6;
/// Points of the bite that are compared: few for each guess, more for the best ones.
constexpr std::size_t kRoughPoints = 500, kFinePoints = 4000, kBestGuesses = 5;
/// Distances up to which points pull, step by step.
constexpr std::array kRoughLimits_mm = {1.5, 1.2, 1.0, 0.8, 0.6, 0.5};
constexpr std::array kFineLimits_mm = {0.5, 0.4, 0.3, 0.25, 0.2, 0.2, 0.15, 0.15};
/// A point nearer to the surface than this, with a similar normal, lies on it. Several times the
/// noise of a finished surface; soft tissue moves farther.
constexpr double kOnSurface_mm = 0.1, kLeastNormalCosine = 0.7;

std::vector<SurfacePoint> every_nth(std::span<const SurfacePoint> points, std::size_t count) {
  count = std::min(count, points.size());
  std::vector<SurfacePoint> chosen;
  for (std::size_t i = 0; i < count; ++i) chosen.push_back(points[i * points.size() / count]);
  return chosen;
}

/// Middles of parts that cover the bite: each as far as possible from those before.
std::vector<Vec3f> part_middles(std::span<const SurfacePoint> points, std::size_t count) {
  std::vector<Vec3f> middles;
  std::vector<float> nearest2_mm2(points.size(), std::numeric_limits<float>::max());
  Vec3f next = Vec3f::Zero();
  for (const SurfacePoint& point : points)
    next += point.position_mm / static_cast<float>(points.size());
  while (middles.size() < std::min(count, points.size())) {
    middles.push_back(next);
    for (std::size_t i = 0; i < points.size(); ++i)
      nearest2_mm2[i] = std::min(nearest2_mm2[i], (points[i].position_mm - next).squaredNorm());
    const auto farthest = std::max_element(nearest2_mm2.begin(), nearest2_mm2.end());
    next = points[static_cast<std::size_t>(farthest - nearest2_mm2.begin())].position_mm;
  }
  return middles;
}

std::vector<Vec3> part_around(std::span<const SurfacePoint> points, const Vec3f& middle_mm) {
  std::vector<Vec3> part;
  for (const SurfacePoint& point : points) {
    if ((point.position_mm - middle_mm).norm() < kPartRadius_mm)
      part.push_back(point.position_mm.cast<double>());
  }
  return part;
}

/// One step towards the surface. Points count less the farther they are, up to the limit.
void improve(const JawSurface& jaw, const std::vector<SurfacePoint>& points, double limit_mm,
             Isometry& T_jaw_bite) {
  Vec3 middle_mm = Vec3::Zero();
  for (const SurfacePoint& p : points)
    middle_mm += p.position_mm.cast<double>() / static_cast<double>(points.size());
  middle_mm = T_jaw_bite * middle_mm;
  Matrix6 normal = Matrix6::Zero();
  Twist right = Twist::Zero();
  for (const SurfacePoint& point : points) {
    const Vec3 p_mm = T_jaw_bite * point.position_mm.cast<double>();
    const auto foot = jaw.foot(p_mm, limit_mm);
    if (!foot ||
        foot->normal.dot(T_jaw_bite.linear() * point.normal.cast<double>()) < kLeastNormalCosine)
      continue;
    const double share = foot->offset_mm / limit_mm;
    const double weight = (1.0 - share * share) * (1.0 - share * share);
    Twist row;
    row << (p_mm - middle_mm).cross(foot->normal), foot->normal;
    normal += weight * row * row.transpose();
    right -= weight * foot->offset_mm * row;
  }
  // A direction that the surface does not fix stays as it is.
  const double damping = 1e-3 * static_cast<double>(points.size());
  normal.diagonal().head<3>().array() += damping * kPartRadius_mm * kPartRadius_mm;
  normal.diagonal().tail<3>().array() += damping;
  const Twist step = solve_symmetric(normal, right);
  T_jaw_bite = Eigen::Translation3d(middle_mm) * exp_twist(step) *
               Eigen::Translation3d(-middle_mm) * T_jaw_bite;
}

struct Guess {
  Isometry T_jaw_bite;
  double share = 0.0;
};

/// Improves all guesses and sorts them, the best first.
template <typename Limits>
void improve_all(const JawSurface& jaw, const std::vector<SurfacePoint>& points,
                 const Limits& limits_mm, const Workers& workers, std::vector<Guess>& guesses) {
  workers.for_each(guesses.size(), [&](std::size_t i) {
    for (const double limit_mm : limits_mm) improve(jaw, points, limit_mm, guesses[i].T_jaw_bite);
    guesses[i].share = lay_on(jaw, points, guesses[i].T_jaw_bite, Workers(1)).share;
  });
  std::stable_sort(guesses.begin(), guesses.end(),
                   [](const Guess& a, const Guess& b) { return a.share > b.share; });
}

}  // namespace

SearchedJaw::SearchedJaw(const TriangleMesh& mesh) : surface(mesh), map(mesh, kPartRadius_mm) {}

BitePlacement lay_on(const JawSurface& jaw, std::span<const SurfacePoint> points,
                     const Isometry& T_jaw_bite, const Workers& workers) {
  // Not vector<bool>: threads write neighbors.
  std::vector<char> on_jaw(points.size(), 0);
  workers.for_each(
      points.size(),
      [&](std::size_t i) {
        const auto foot =
            jaw.foot(T_jaw_bite * points[i].position_mm.cast<double>(), kOnSurface_mm);
        on_jaw[i] = foot && foot->normal.dot(T_jaw_bite.linear() *
                                             points[i].normal.cast<double>()) > kLeastNormalCosine;
      },
      256);
  BitePlacement placement{T_jaw_bite, {on_jaw.begin(), on_jaw.end()}, 0.0};
  const auto count = std::count(on_jaw.begin(), on_jaw.end(), 1);
  placement.share =
      static_cast<double>(count) / static_cast<double>(std::max<std::size_t>(points.size(), 1));
  return placement;
}

BitePlacement place_bite(const SearchedJaw& jaw, std::span<const SurfacePoint> points,
                         const Workers& workers) {
  const std::vector<Vec3f> middles = part_middles(points, kParts);
  std::vector<std::vector<Guess>> by_part(middles.size());
  workers.for_each(middles.size(), [&](std::size_t i) {
    for (const tracking::PoseGuess& guess : tracking::search_poses(
             jaw.map, part_around(points, middles[i]), kPartRadius_mm, kGuessesByPart)) {
      by_part[i].push_back({guess.T_world_sensor, 0.0});
    }
  });
  std::vector<Guess> guesses;
  for (const auto& part : by_part) guesses.insert(guesses.end(), part.begin(), part.end());
  if (guesses.empty()) return {Isometry::Identity(), std::vector<bool>(points.size(), false), 0.0};
  improve_all(jaw.surface, every_nth(points, kRoughPoints), kRoughLimits_mm, workers, guesses);
  guesses.resize(std::min(guesses.size(), kBestGuesses));
  improve_all(jaw.surface, every_nth(points, kFinePoints), kFineLimits_mm, workers, guesses);
  return lay_on(jaw.surface, points, guesses.front().T_jaw_bite, workers);
}

}  // namespace flytri::occlusion
