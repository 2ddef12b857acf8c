#include "core/tracking/entry_starts.h"

#include <algorithm>
#include <limits>

#include "core/trajectory/path_fit.h"

namespace flytri::tracking {
namespace {

/// Distance between neighboring start poses, as a share of the radius. From half of the diagonal of
/// this grid, the registration succeeds in nine of ten cases.
constexpr double kStartSpacingShare = 0.22;

void append_unless_near(const Isometry& T, double distance_mm, double arm_mm,
                        std::vector<Isometry>& poses) {
  const bool near = std::any_of(poses.begin(), poses.end(), [&](const Isometry& T_known) {
    return trajectory::pose_chord_mm(T_known, T, arm_mm) < distance_mm;
  });
  if (!near) poses.push_back(T);
}

/// A pose and its neighbors along the surface, two steps to each side, nearest first.
std::vector<Isometry> poses_around(const Isometry& T_world_sensor, double radius_mm) {
  std::vector<Eigen::Array2i> steps;
  for (int i = -2; i <= 2; ++i) {
    for (int j = -2; j <= 2; ++j) steps.emplace_back(i, j);
  }
  std::stable_sort(steps.begin(), steps.end(), [](const auto& a, const auto& b) {
    return a.matrix().squaredNorm() < b.matrix().squaredNorm();
  });
  std::vector<Isometry> poses;
  for (const Eigen::Array2i& step : steps) {
    const Eigen::Vector2d shift_mm = kStartSpacingShare * radius_mm * step.cast<double>().matrix();
    poses.push_back(T_world_sensor * Eigen::Translation3d(shift_mm.x(), shift_mm.y(), 0.0));
  }
  return poses;
}

/// How the returning hand may hold the sensor, as twists relative to an earlier pose: unchanged,
/// tilted about x or y, turned about the line of sight, or shifted along the surface.
std::vector<Twist> holds(double radius_mm) {
  constexpr double kTilt_rad = 0.4, kTurn_rad = 0.35, kShiftShare = 0.4;
  std::vector<Twist> offs = {Twist::Zero()};
  const auto add = [&](int axis, double amount) {
    for (const double sense : {1.0, -1.0}) offs.push_back(sense * amount * Twist::Unit(axis));
  };
  for (const double tilt_rad : {kTilt_rad, 2.0 * kTilt_rad}) {
    for (const int axis : {0, 1}) add(axis, tilt_rad);
  }
  add(2, kTurn_rad);
  const std::size_t turned = offs.size();
  for (const int axis : {3, 4}) add(axis, kShiftShare * radius_mm);
  for (std::size_t shift = turned; shift < turned + 4; ++shift) {
    for (std::size_t turn = 1; turn < turned; ++turn) offs.push_back(offs[shift] + offs[turn]);
  }
  return offs;
}

}  // namespace

EntryStarts::EntryStarts(const TrackedScan& scan, const std::vector<Isometry>& stops,
                         double radius_mm, const Hints& hints)
    : scan_(scan), stops_(stops), radius_mm_(radius_mm), hints_(hints), holds_(holds(radius_mm)) {}

std::vector<Isometry> path_stops(const TrackedScan& scan, double radius_mm) {
  constexpr double kApartShare = 0.35;
  std::vector<Isometry> stops;
  for (const TrackedView& view : scan.views()) {
    append_unless_near(view.aligned.T_world_sensor, kApartShare * radius_mm, radius_mm, stops);
  }
  return stops;
}

/// Each stop of the path combined with each way to hold the sensor, likelier ways first.
Isometry EntryStarts::on_path(std::size_t number) const {
  const std::size_t hold = number / stops_.size() % holds_.size();
  return stops_[number % stops_.size()] * exp_twist(holds_[hold]);
}

/// Poses where the scan stopped, where it would be if the hand continued, where it was resumed, and
/// where the user was asked to resume.
std::vector<Isometry> EntryStarts::anchors(double time_s) const {
  const trajectory::Trajectory& trajectory = scan_.trajectory();
  std::vector<Isometry> candidates = trajectory.guesses(time_s);
  const std::vector<trajectory::TimedPose> later =
      trajectory.between(time_s, time_s + hints_.max_gap_s);
  if (!later.empty()) candidates.push_back(later.front().T_world_sensor);
  if (hints_.T_world_asked) candidates.insert(candidates.begin(), *hints_.T_world_asked);
  if (hints_.T_world_proposed) candidates.push_back(*hints_.T_world_proposed);
  std::vector<Isometry> result;
  for (const Isometry& T_world_sensor : candidates) {
    append_unless_near(T_world_sensor, kStartSpacingShare * radius_mm_, radius_mm_, result);
  }
  return result;
}

std::vector<Isometry> EntryStarts::near_anchors(double time_s) const {
  std::vector<Isometry> near;
  for (const Isometry& T_world_anchor : anchors(time_s)) {
    const std::vector<Isometry> poses = poses_around(T_world_anchor, radius_mm_);
    near.insert(near.end(), poses.begin(), poses.end());
  }
  return near;
}

std::vector<Isometry> EntryStarts::all(double time_s, std::size_t most) const {
  std::vector<Isometry> starts = near_anchors(time_s);
  for (std::size_t i = 0; i < stops_.size() * holds_.size(); ++i) starts.push_back(on_path(i));
  starts.resize(std::min(starts.size(), most));
  return starts;
}

std::vector<Isometry> EntryStarts::few(double time_s, std::size_t count, std::size_t turn) const {
  const std::vector<Isometry> near = near_anchors(time_s);
  std::vector<Isometry> starts = likeliest();
  const std::size_t more = count > starts.size() ? count - starts.size() : 1;
  for (std::size_t i = turn * more; i < (turn + 1) * more; ++i) {
    starts.push_back(i % 2 == 0 ? near[i / 2 % near.size()] : on_path(i / 2));
  }
  return starts;
}

std::vector<Isometry> EntryStarts::likeliest() const {
  std::vector<Isometry> entries;
  if (hints_.T_world_asked) {
    entries.push_back(*hints_.T_world_asked);
  } else if (hints_.T_world_proposed) {
    entries.push_back(*hints_.T_world_proposed);
  }
  const trajectory::Trajectory& trajectory = scan_.trajectory();
  if (!trajectory.empty()) {
    const trajectory::TimedPose last = trajectory.before(trajectory.last_time_s(), 1).front();
    append_unless_near(last.T_world_sensor, kStartSpacingShare * radius_mm_, radius_mm_, entries);
  }
  return entries;
}

Isometry EntryStarts::at_its_depth(const Isometry& T_world_start,
                                   const IncomingView& incoming) const {
  const TrackedView* nearest = nullptr;
  double nearest_mm = std::numeric_limits<double>::infinity();
  for (const TrackedView& view : scan_.views()) {
    const double off_mm =
        trajectory::pose_chord_mm(T_world_start, view.aligned.T_world_sensor, radius_mm_);
    if (view.aligned.view->profiles.empty() || off_mm >= nearest_mm) continue;
    nearest = &view;
    nearest_mm = off_mm;
  }
  if (nearest == nullptr) return T_world_start;
  const double seen_mm =
      (nearest->aligned.T_world_sensor.inverse() * nearest->placed.center_mm).z();
  return T_world_start * Eigen::Translation3d(0.0, 0.0, seen_mm - incoming.prepared.center_mm.z());
}

}  // namespace flytri::tracking
