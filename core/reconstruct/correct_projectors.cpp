#include "core/reconstruct/correct_projectors.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace flytri::reconstruct {
namespace {

/// Views this near to a knock do not count: its time is not exact, and the sensor shakes.
constexpr double kKnock_s = 0.15;
/// Least improvement of the fit: by less, the wrong projector can seem to be the better one.
constexpr double kClearShare = 0.0015;

/// True if the view's projector may have been moving.
bool may_be_moving(const View& view, std::span<const refinement::ProjectorMotion> moved) {
  return std::any_of(moved.begin(), moved.end(), [&](const refinement::ProjectorMotion& m) {
    return view.pattern == m.pattern && (std::abs(view.time_s - m.from_s) < kKnock_s ||
                                         std::abs(view.time_s - m.to_s) < kKnock_s);
  });
}

/// Moves the left out views to the path of the others.
void place_between(std::span<AlignedView> views, const std::vector<bool>& left_out) {
  const AlignedView* before = nullptr;
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (!left_out[i]) {
      before = &views[i];
      continue;
    }
    std::size_t next = i;
    while (next < views.size() && left_out[next]) ++next;
    if (before == nullptr || next == views.size()) continue;
    const double from_s = before->view->time_s, to_s = views[next].view->time_s;
    views[i].T_world_sensor =
        interpolate(before->T_world_sensor, views[next].T_world_sensor,
                    to_s > from_s ? (views[i].view->time_s - from_s) / (to_s - from_s) : 0.0);
  }
}

double misfit_mm(const refinement::Refinement& refinement) {
  return refinement.robust_sigma_mm.empty() ? 0.0 : refinement.robust_sigma_mm.back();
}

bool fits_better(const CorrectedScan& a, const CorrectedScan& b) {
  return misfit_mm(a.refinement) < misfit_mm(b.refinement);
}

/// The scan if these projectors moved.
Result<CorrectedScan> refined_with(std::span<const AlignedView> views,
                                   std::vector<refinement::ProjectorMotion> moved,
                                   const Vec3& p_camera_mm,
                                   const refinement::JointRefineOptions& options,
                                   const Workers& workers, const Progress& progress) {
  CorrectedScan scan{{views.begin(), views.end()}, std::move(moved), {}};
  std::vector<bool> left_out;
  for (AlignedView& view : scan.views) {
    left_out.push_back(may_be_moving(*view.view, scan.moved));
    if (left_out.back()) view.view = without_points(*view.view);
  }
  auto refined = refinement::refine_with_projectors(scan.views, scan.moved, p_camera_mm, options,
                                                    workers, progress);
  if (!refined) return tl::unexpected(refined.error());
  scan.refinement = *std::move(refined);
  place_between(scan.views, left_out);
  return scan;
}

}  // namespace

Result<std::optional<CorrectedScan>> correct_projectors(
    std::span<const AlignedView> views, const refinement::Refinement& fit,
    std::span<const calibration::ShiftedSpan> shifted, const calibration::Calibration& calibration,
    const refinement::JointRefineOptions& options, const Workers& workers,
    const Progress& progress) {
  const std::optional<Vec3> p_camera_mm = calibration.camera_center_mm();
  if (shifted.empty() || !p_camera_mm) {
    progress.advance();
    return std::nullopt;
  }
  const Progress of_one =
      progress.part(1.0 / static_cast<double>(kPatterns.size() * shifted.size()));
  std::optional<CorrectedScan> corrected;
  for (const calibration::ShiftedSpan& span : shifted) {
    std::vector<CorrectedScan> scans;
    for (const Pattern pattern : kPatterns) {
      auto moved = corrected ? corrected->moved : std::vector<refinement::ProjectorMotion>();
      moved.push_back({pattern, span.from_s, span.to_s, Twist::Zero()});
      auto scan = refined_with(views, std::move(moved), *p_camera_mm, options, workers, of_one);
      if (!scan) return tl::unexpected(scan.error());
      scans.push_back(*std::move(scan));
    }
    const auto [best, other] = std::minmax_element(scans.begin(), scans.end(), fits_better);
    const double former_mm = misfit_mm(corrected ? corrected->refinement : fit);
    const double next_best_mm = std::min(misfit_mm(other->refinement), former_mm);
    if (misfit_mm(best->refinement) < (1.0 - kClearShare) * next_best_mm)
      corrected = std::move(*best);
  }
  return corrected;
}

}  // namespace flytri::reconstruct
