#include "core/tracking/pose_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <tuple>

#include "core/geometry/decompositions.h"
#include "core/trajectory/path_fit.h"

namespace flytri::tracking {
namespace {

/// Directions of sight on the sphere and rolls about each: neighbors are about 18 degrees apart.
constexpr int kDirections = 130, kRolls = 20;
/// Cosine of the largest tilt against the direction from which the scan saw a place.
constexpr double kLeastCosine = 0.45;
/// Points of the view that are compared: a few first, which tell most wrong poses.
constexpr std::size_t kFirstPoints = 12, kCoarsePoints = 48, kFinePoints = 150;
/// Best rotations kept for each place, and poses kept in all.
constexpr std::size_t kKeptByPlace = 3, kKeptRough = 1500, kKeptMiddle = 200, kKeptFine = 40;
constexpr int kRoughSteps = 4, kMiddleSteps = 5, kFineSteps = 8;
/// Distances are cut off at this share of the radius.
constexpr double kCutShare = 0.12;
/// A point beside the scan costs this share of the largest distance: a part of the view may lie
/// there.
constexpr double kUnknownCost = 0.5;
/// Guesses nearer than this are one, as a share of the radius.
constexpr double kGuessApartShare = 0.12;

/// Larger than the cost of any pose.
constexpr std::uint32_t kWorst = 256 * kCoarsePoints;

/// A rotation of the lattice at a place.
struct Rough {
  std::uint32_t cost = 0;
  std::uint32_t place = 0;
  std::uint32_t rotation = 0;

  bool operator<(const Rough& other) const {
    return std::tie(cost, place, rotation) < std::tie(other.cost, other.place, other.rotation);
  }
};

std::vector<Eigen::Matrix3d> rotations_towards(const Vec3& sight) {
  std::vector<Eigen::Matrix3d> rotations;
  // The shortest turn from z to the unit vector `sight`. Quaterniond::FromTwoVectors compiles
  // slowly.
  Eigen::Quaterniond towards(1.0 + sight.z(), -sight.y(), sight.x(), 0.0);
  if (towards.norm() < 1e-9) towards = Eigen::Quaterniond(0.0, 1.0, 0.0, 0.0);
  towards.normalize();
  for (int roll = 0; roll < kRolls; ++roll) {
    const double angle_rad = 2.0 * std::numbers::pi * roll / kRolls;
    rotations.push_back((towards * Eigen::AngleAxisd(angle_rad, Vec3::UnitZ())).toRotationMatrix());
  }
  return rotations;
}

/// Directions that are spread evenly.
/// @source  Fibonacci lattice.
std::vector<Vec3> directions() {
  std::vector<Vec3> all;
  for (int i = 0; i < kDirections; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / kDirections;
    const double angle_rad = i * std::numbers::pi * (3.0 - std::sqrt(5.0));
    const double r = std::sqrt(1.0 - z * z);
    all.emplace_back(r * std::cos(angle_rad), r * std::sin(angle_rad), z);
  }
  return all;
}

/// Points spread over all, so that the first few of them are spread, too.
std::vector<Vec3> spread(std::span<const Vec3> points_mm, std::size_t count) {
  count = std::min(count, points_mm.size());
  std::vector<Vec3> chosen;
  // Multiples of the golden section are spread evenly, however many are taken.
  const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
  for (std::size_t i = 0; i < count; ++i) {
    const double share = std::fmod(0.5 + static_cast<double>(i) * golden, 1.0);
    chosen.push_back(
        points_mm[static_cast<std::size_t>(share * static_cast<double>(points_mm.size()))]);
  }
  return chosen;
}

class Search {
 public:
  Search(const SurfaceMap& map, std::span<const Vec3> points_mm, double radius_mm)
      : map_(map),
        radius_mm_(radius_mm),
        coarse_mm_(spread(points_mm, kCoarsePoints)),
        fine_mm_(spread(points_mm, kFinePoints)) {
    Vec3 middle_mm = Vec3::Zero();
    for (const Vec3& p_mm : points_mm) middle_mm += p_mm / static_cast<double>(points_mm.size());
    anchor_mm_ =
        *std::min_element(points_mm.begin(), points_mm.end(), [&](const Vec3& a, const Vec3& b) {
          return (a - middle_mm).squaredNorm() < (b - middle_mm).squaredNorm();
        });
  }

  [[nodiscard]] std::vector<PoseGuess> run_from(const std::vector<Isometry>& T_world_starts,
                                                std::size_t count) const {
    std::vector<PoseGuess> guesses;
    guesses.reserve(T_world_starts.size());
    for (const Isometry& T_world_start : T_world_starts) guesses.push_back({T_world_start, 0.0});
    guesses = improved(std::move(guesses), coarse_mm_, kRoughSteps);
    guesses.resize(std::min(guesses.size(), kKeptMiddle));
    return apart(improved(std::move(guesses), fine_mm_, kFineSteps), count);
  }

  [[nodiscard]] std::vector<PoseGuess> run_anywhere(std::size_t count) {
    // Points farther out than the margin of the grid would leave it.
    std::erase_if(coarse_mm_,
                  [&](const Vec3& p_mm) { return (p_mm - anchor_mm_).norm() > 2.8 * radius_mm_; });
    costs_.reserve(map_.coarse.distances_mm().size());
    for (const float distance_mm : map_.coarse.distances_mm()) {
      const double cost = std::isnan(distance_mm)
                              ? kUnknownCost
                              : std::min(1.0, std::abs(distance_mm) / map_.coarse.most_mm());
      costs_.push_back(static_cast<std::uint8_t>(255.0 * cost));
    }
    for (const SurfacePlace& place : map_.places)
      bases_.push_back(map_.coarse.index_of(place.p_mm));
    best_.assign(map_.places.size(), {});
    for (auto& best : best_) best.fill(Rough{kWorst, 0, 0});
    for (const Vec3& sight : directions()) {
      for (const Eigen::Matrix3d& rotation : rotations_towards(sight)) try_everywhere(rotation);
    }
    std::vector<PoseGuess> guesses = improved(rough_guesses(), coarse_mm_, kRoughSteps);
    guesses.resize(std::min(guesses.size(), kKeptMiddle));
    guesses = apart(improved(std::move(guesses), fine_mm_, kMiddleSteps), kKeptFine);
    return apart(improved(std::move(guesses), fine_mm_, kFineSteps), count);
  }

 private:
  void try_everywhere(const Eigen::Matrix3d& rotation) {
    std::array<int, kCoarsePoints> offsets;
    const auto number = static_cast<std::uint32_t>(rotations_.size());
    rotations_.push_back(rotation);
    for (std::size_t k = 0; k < coarse_mm_.size(); ++k) {
      const Vec3 off = rotation * (coarse_mm_[k] - anchor_mm_) / map_.coarse.cell_mm();
      offsets[k] = off.array().round().cast<int>().matrix().dot(map_.coarse.strides());
    }
    const std::size_t first = std::min(kFirstPoints, coarse_mm_.size());
    for (std::size_t i = 0; i < map_.places.size(); ++i) {
      if (map_.places[i].sight.dot(rotation.col(2)) < kLeastCosine) continue;
      const std::uint8_t* at = &costs_[static_cast<std::size_t>(bases_[i])];
      std::uint32_t cost = 0;
      for (std::size_t k = 0; k < first; ++k) cost += at[offsets[k]];
      auto& best = best_[i];
      // A little worse than the best ones so far is still worth the rest.
      if (cost * coarse_mm_.size() > (best.back().cost / 4 + best.back().cost) * first) continue;
      for (std::size_t k = first; k < coarse_mm_.size(); ++k) cost += at[offsets[k]];
      if (cost >= best.back().cost) continue;
      best.back() = {cost, static_cast<std::uint32_t>(i), number};
      std::sort(best.begin(), best.end());
    }
  }

  [[nodiscard]] std::vector<PoseGuess> rough_guesses() const {
    std::vector<Rough> all;
    for (const auto& best : best_) {
      for (const Rough& rough : best) {
        if (rough.cost != kWorst) all.push_back(rough);
      }
    }
    const std::size_t kept = std::min(kKeptRough, all.size());
    std::partial_sort(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(kept), all.end());
    std::vector<PoseGuess> guesses;
    for (std::size_t i = 0; i < kept; ++i) {
      PoseGuess guess;
      guess.T_world_sensor.linear() = rotations_[all[i].rotation];
      guess.T_world_sensor.translation() =
          map_.places[all[i].place].p_mm - rotations_[all[i].rotation] * anchor_mm_;
      guesses.push_back(guess);
    }
    return guesses;
  }

  [[nodiscard]] std::vector<PoseGuess> improved(std::vector<PoseGuess> guesses,
                                                const std::vector<Vec3>& points_mm,
                                                int steps) const {
    for (PoseGuess& guess : guesses) {
      for (int i = 0; i < steps; ++i) improve(guess.T_world_sensor, points_mm);
      guess.off_mm = off_mm(guess.T_world_sensor, points_mm);
    }
    std::stable_sort(guesses.begin(), guesses.end(),
                     [](const PoseGuess& a, const PoseGuess& b) { return a.off_mm < b.off_mm; });
    return guesses;
  }

  [[nodiscard]] double off_mm(const Isometry& T_world_sensor,
                              const std::vector<Vec3>& points_mm) const {
    const double cut_mm = kCutShare * radius_mm_;
    double sum_mm = 0.0;
    for (const Vec3& p_mm : points_mm) {
      const DistanceGrid::Sample sample = map_.fine.at(T_world_sensor * p_mm);
      sum_mm +=
          sample.is_known ? std::min(std::abs(sample.distance_mm), cut_mm) : kUnknownCost * cut_mm;
    }
    return sum_mm / static_cast<double>(points_mm.size());
  }

  /// One step of Gauss and Newton towards smaller distances. Points that are far off count less.
  void improve(Isometry& T_world_sensor, const std::vector<Vec3>& points_mm) const {
    const double far_mm = 0.5 * map_.fine.most_mm();
    Matrix6 normal = Matrix6::Zero();
    Twist right = Twist::Zero();
    for (const Vec3& p_mm : points_mm) {
      const Vec3 arm_mm = T_world_sensor.linear() * (p_mm - anchor_mm_);
      const DistanceGrid::Sample sample = map_.fine.at(T_world_sensor * p_mm);
      if (!sample.is_known) continue;
      const double ratio = sample.distance_mm / far_mm;
      const double weight = 1.0 / (1.0 + ratio * ratio);
      Twist row;
      row << arm_mm.cross(sample.slope), sample.slope;
      normal.selfadjointView<Eigen::Lower>().rankUpdate(row, weight);
      right -= weight * sample.distance_mm * row;
    }
    // A direction that the surface does not fix stays as it is.
    const double damping = 0.01 * static_cast<double>(points_mm.size());
    normal.diagonal().head<3>().array() += damping * radius_mm_ * radius_mm_ / 4.0;
    normal.diagonal().tail<3>().array() += damping;
    const Twist step = solve_symmetric(normal, right);
    const Vec3 anchor_world_mm = T_world_sensor * anchor_mm_;
    T_world_sensor = Eigen::Translation3d(anchor_world_mm) * exp_twist(step) *
                     Eigen::Translation3d(-anchor_world_mm) * T_world_sensor;
  }

  [[nodiscard]] std::vector<PoseGuess> apart(const std::vector<PoseGuess>& sorted,
                                             std::size_t count) const {
    std::vector<PoseGuess> kept;
    for (const PoseGuess& guess : sorted) {
      if (kept.size() >= count) break;
      const bool known = std::any_of(kept.begin(), kept.end(), [&](const PoseGuess& other) {
        return trajectory::pose_chord_mm(other.T_world_sensor, guess.T_world_sensor, radius_mm_) <
               kGuessApartShare * radius_mm_;
      });
      if (!known) kept.push_back(guess);
    }
    return kept;
  }

  const SurfaceMap& map_;
  double radius_mm_;
  std::vector<Vec3> coarse_mm_, fine_mm_;  ///< sensor frame
  Vec3 anchor_mm_ = Vec3::Zero();          ///< the point of the view that is laid on each place
  std::vector<std::uint8_t> costs_;        ///< of the coarse grid
  std::vector<int> bases_;                 ///< of the places in it
  std::vector<Eigen::Matrix3d> rotations_;
  std::vector<std::array<Rough, kKeptByPlace>> best_;  ///< by place
};

}  // namespace

std::vector<PoseGuess> search_poses(const SurfaceMap& map, std::span<const Vec3> points_mm,
                                    double radius_mm, std::size_t count) {
  if (map.places.empty() || points_mm.empty()) return {};
  return Search(map, points_mm, radius_mm).run_anywhere(count);
}

std::vector<PoseGuess> improve_poses(const SurfaceMap& map,
                                     const std::vector<Isometry>& T_world_starts,
                                     std::span<const Vec3> points_mm, double radius_mm,
                                     std::size_t count) {
  if (map.places.empty() || points_mm.empty()) return {};
  return Search(map, points_mm, radius_mm).run_from(T_world_starts, count);
}

}  // namespace flytri::tracking
