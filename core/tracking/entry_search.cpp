#include "core/tracking/entry_search.h"

#include <algorithm>
#include <limits>

#include "core/trajectory/path_fit.h"

namespace flytri::tracking {
namespace {

/// Start poses nearer than this are one, and so are the guesses of a search, which fit: shares of
/// the radius.
constexpr double kApartShare = 0.22, kSameGuessShare = 0.1;
/// Distance of neighboring poses where the search is dense, as a share of the radius.
constexpr double kStopShare = 0.25;
/// Guesses near likely poses and near the path of the scan.
constexpr std::size_t kNearGuesses = 6;
/// The path of the hand is continued for so long.
constexpr double kMovesOn_s = 1.0;
/// Views before and after one that are searched together with it.
constexpr std::size_t kTogether = 4;
/// Every n-th knot of a profile is taken: the search needs few.
constexpr std::size_t kKnotStride = 4;

void append_unless_near(const Isometry& T, double distance_mm, double arm_mm,
                        std::vector<Isometry>& poses) {
  const bool near = std::any_of(poses.begin(), poses.end(), [&](const Isometry& T_known) {
    return trajectory::pose_chord_mm(T_known, T, arm_mm) < distance_mm;
  });
  if (!near) poses.push_back(T);
}

/// The pose moved along the line of sight, so that the view's surface has the distance from the
/// sensor that it had in the nearest registered view: the user may resume nearer or farther.
Isometry at_its_depth(const TrackedScan& scan, const Isometry& T_world_start,
                      const IncomingView& incoming, double radius_mm) {
  const TrackedView* nearest = nullptr;
  double nearest_mm = std::numeric_limits<double>::infinity();
  for (const TrackedView& view : scan.views()) {
    const double off_mm =
        trajectory::pose_chord_mm(T_world_start, view.aligned.T_world_sensor, radius_mm);
    if (view.placed.profiles.empty() || off_mm >= nearest_mm) continue;
    nearest = &view;
    nearest_mm = off_mm;
  }
  if (nearest == nullptr) return T_world_start;
  const double seen_mm =
      (nearest->aligned.T_world_sensor.inverse() * nearest->placed.center_mm).z();
  return T_world_start * Eigen::Translation3d(0.0, 0.0, seen_mm - incoming.prepared.center_mm.z());
}

/// The poses of the scan, thinned.
std::vector<Isometry> stops_of(const TrackedScan& scan, double radius_mm) {
  std::vector<Isometry> stops;
  for (const TrackedView& view : scan.views()) {
    append_unless_near(view.aligned.T_world_sensor, kStopShare * radius_mm, radius_mm, stops);
  }
  return stops;
}

/// Poses around one, shifted along the surface.
void append_shifted(const Isometry& T_world_start, double radius_mm, std::vector<Isometry>& poses) {
  constexpr int kSteps = 2;
  for (int x = -kSteps; x <= kSteps; ++x) {
    for (int y = -kSteps; y <= kSteps; ++y) {
      const Vec3 shift_mm = kStopShare * radius_mm * Vec3(x, y, 0.0);
      poses.push_back(T_world_start * Eigen::Translation3d(shift_mm));
    }
  }
}

}  // namespace

std::vector<Vec3> points_around(const TrackedScan& submap, std::size_t i) {
  const Isometry T_sensor_submap = submap.views()[i].aligned.T_world_sensor.inverse();
  std::vector<Vec3> points_mm;
  const std::size_t from = i > kTogether ? i - kTogether : 0;
  for (std::size_t j = from; j < std::min(i + kTogether + 1, submap.size()); ++j) {
    for (const registration::PreparedProfile& profile : submap.views()[j].placed.profiles) {
      for (std::size_t k = 0; k < profile.curve.knot_count(); k += kKnotStride) {
        points_mm.emplace_back(T_sensor_submap * profile.curve.knot_mm(k).cast<double>());
      }
    }
  }
  return points_mm;
}

std::vector<Isometry> EntrySearch::likely(const TrackedScan& scan, const IncomingView& incoming,
                                          const Hints& hints, double radius_mm) {
  std::vector<Isometry> entries;
  if (hints.T_world_asked) {
    entries.push_back(*hints.T_world_asked);
  } else if (hints.T_world_proposed) {
    entries.push_back(*hints.T_world_proposed);
  }
  const double time_s = incoming.view->time_s;
  const trajectory::Trajectory& trajectory = scan.trajectory();
  const auto before = trajectory.before(time_s, 1);
  const auto after = trajectory.between(time_s, time_s + hints.max_gap_s);
  const auto append = [&](const Isometry& T_world_sensor) {
    append_unless_near(T_world_sensor, kApartShare * radius_mm, radius_mm, entries);
  };
  if (!before.empty()) append(before.front().T_world_sensor);
  if (!after.empty()) append(after.front().T_world_sensor);
  // The hand may have moved on while it was lost.
  if (trajectory.last_time_s() >= time_s - kMovesOn_s) {
    for (const Isometry& guess : trajectory.guesses(time_s)) append(guess);
  }
  for (Isometry& entry : entries) entry = at_its_depth(scan, entry, incoming, radius_mm);
  return entries;
}

std::vector<Isometry> EntrySearch::search(const TrackedScan& scan,
                                          const std::vector<Isometry>& likely,
                                          const std::vector<Vec3>& points_mm, double radius_mm,
                                          std::size_t count) {
  if (surface_ == nullptr || scan_ != &scan || views_ != scan.size()) {
    surface_ = std::make_unique<const SurfaceMap>(scan, radius_mm);
    stops_ = stops_of(scan, radius_mm);
    scan_ = &scan;
    views_ = scan.size();
  }
  std::vector<Isometry> starts = stops_;
  for (const Isometry& pose : likely) append_shifted(pose, radius_mm, starts);
  std::vector<PoseGuess> guesses =
      improve_poses(*surface_, starts, points_mm, radius_mm, kNearGuesses);
  const std::vector<PoseGuess> anywhere = search_poses(*surface_, points_mm, radius_mm, count);
  guesses.insert(guesses.end(), anywhere.begin(), anywhere.end());
  std::vector<Isometry> entries;
  for (const PoseGuess& guess : guesses) {
    append_unless_near(guess.T_world_sensor, kSameGuessShare * radius_mm, radius_mm, entries);
  }
  return entries;
}

}  // namespace flytri::tracking
