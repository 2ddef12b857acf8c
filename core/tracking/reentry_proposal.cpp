#include "core/tracking/reentry_proposal.h"

#include <algorithm>

#include "core/trajectory/path_fit.h"

namespace flytri::tracking {
namespace {

/// Number of points of views i - 1 and i.
std::size_t points_at(const std::vector<TrackedView>& views, std::size_t i) {
  return views[i - 1].aligned.view->point_count() + views[i].aligned.view->point_count();
}

ReentryProposal pair_at(const std::vector<TrackedView>& views, std::size_t i) {
  return {views[i - 1].aligned, views[i].aligned, points_at(views, i)};
}

}  // namespace

std::optional<ReentryProposal> propose_reentry(const TrackedScan& scan, int latest_pairs) {
  const std::vector<TrackedView>& views = scan.views();
  if (views.size() < 2) return std::nullopt;
  const auto pairs = std::min(views.size() - 1, static_cast<std::size_t>(latest_pairs));
  ReentryProposal best;
  for (std::size_t i = views.size() - 1; i >= views.size() - pairs; --i) {
    if (points_at(views, i) > best.point_count) best = pair_at(views, i);
  }
  return best;
}

std::vector<ReentryProposal> propose_reentries(const TrackedScan& scan, int latest_pairs,
                                               std::size_t count, double apart_mm) {
  std::vector<ReentryProposal> ranked;
  if (const auto best = propose_reentry(scan, latest_pairs)) ranked.push_back(*best);
  if (ranked.empty()) return ranked;
  const std::vector<TrackedView>& views = scan.views();
  std::vector<std::pair<std::size_t, std::size_t>> rated;  // by falling number of points, then by
                                                           // time
  for (std::size_t i = 1; i < views.size(); ++i) {
    rated.emplace_back(points_at(views, i), i);
  }
  std::stable_sort(rated.begin(), rated.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  for (const auto& [points, i] : rated) {
    if (ranked.size() >= count) break;
    const Isometry& T_world_sensor = views[i].aligned.T_world_sensor;
    const bool near = std::any_of(ranked.begin(), ranked.end(), [&](const ReentryProposal& known) {
      return trajectory::pose_chord_mm(known.second.T_world_sensor, T_world_sensor, apart_mm) <
             apart_mm;
    });
    if (!near) ranked.push_back(pair_at(views, i));
  }
  return ranked;
}

}  // namespace flytri::tracking
