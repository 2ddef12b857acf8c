#include "core/tracking/reentry_proposal.h"

#include <algorithm>

#include "core/trajectory/path_fit.h"

namespace flytri::tracking {
namespace {

/// Candidates along the scan are at least this far apart, as a share of `apart_mm`.
constexpr double kCandidateShare = 0.35;

ReentryProposal pair_at(TrackedScan& scan, std::size_t i) {
  return {scan.views()[i - 1].aligned, scan.views()[i].aligned,
          std::max(scan.uncertainty_mm(i - 1), scan.uncertainty_mm(i))};
}

bool is_near(const AlignedView& view, const AlignedView& other, double distance_mm, double arm_mm) {
  return trajectory::pose_chord_mm(view.T_world_sensor, other.T_world_sensor, arm_mm) < distance_mm;
}

/// Numbers of views all over the scan, each the second of a pair in which both have points.
std::vector<std::size_t> candidates(const TrackedScan& scan, double apart_mm) {
  std::vector<std::size_t> chosen;
  for (std::size_t i = 1; i < scan.size(); ++i) {
    const AlignedView& view = scan.views()[i].aligned;
    const bool has_points =
        !scan.views()[i].placed.profiles.empty() && !scan.views()[i - 1].placed.profiles.empty();
    if (!has_points) continue;
    const bool known = std::any_of(chosen.begin(), chosen.end(), [&](std::size_t other) {
      return is_near(view, scan.views()[other].aligned, kCandidateShare * apart_mm, apart_mm);
    });
    if (!known) chosen.push_back(i);
  }
  return chosen;
}

}  // namespace

std::optional<ReentryProposal> propose_reentry(TrackedScan& scan, int latest_pairs) {
  if (scan.size() < 2) return std::nullopt;
  const auto pairs = std::min(scan.size() - 1, static_cast<std::size_t>(latest_pairs));
  ReentryProposal best = pair_at(scan, scan.size() - 1);
  for (std::size_t i = scan.size() - 2; i >= scan.size() - pairs; --i) {
    const ReentryProposal other = pair_at(scan, i);
    if (other.uncertainty_mm < best.uncertainty_mm) best = other;
  }
  return best;
}

std::vector<ReentryProposal> propose_reentries(TrackedScan& scan, int latest_pairs,
                                               std::size_t count, double apart_mm) {
  std::vector<ReentryProposal> ranked;
  if (const auto best = propose_reentry(scan, latest_pairs)) ranked.push_back(*best);
  if (ranked.empty()) return ranked;
  std::vector<ReentryProposal> others;
  for (const std::size_t i : candidates(scan, apart_mm)) others.push_back(pair_at(scan, i));
  std::stable_sort(others.begin(), others.end(),
                   [](const ReentryProposal& a, const ReentryProposal& b) {
                     return a.uncertainty_mm < b.uncertainty_mm;
                   });
  for (const ReentryProposal& other : others) {
    if (ranked.size() >= count) break;
    const bool near = std::any_of(ranked.begin(), ranked.end(), [&](const ReentryProposal& known) {
      return is_near(known.second, other.second, apart_mm, apart_mm);
    });
    if (!near) ranked.push_back(other);
  }
  return ranked;
}

}  // namespace flytri::tracking
