#include "core/reconstruct/same_jaw.h"

#include "core/evaluation/best_fit.h"
#include "core/evaluation/surface_error.h"
#include "core/occlusion/place_bite.h"

namespace flytri::reconstruct {
namespace {

/// The rest may have changed: prepared teeth, a scan body in place of a tooth, gum.
constexpr double kLeastShare = 0.4;

}  // namespace

Result<Isometry> place_on_jaw(const JawScan& jaw, const JawScan& other, const Workers& workers) {
  const occlusion::JawSurface surface(*jaw.surface);
  const std::vector<SurfacePoint>& points = other.surface->vertices;
  occlusion::BitePlacement placed =
      occlusion::lay_on(surface, points, Isometry::Identity(), workers);
  if (placed.share < kLeastShare)
    placed = occlusion::place_bite(occlusion::SearchedJaw(*jaw.surface), points, workers);
  if (placed.share < kLeastShare) {
    return fail(ErrorCode::kInconsistent,
                "{}: does not fit {}: only {:.0f} % of its points lie on it (at least {:.0f} % are "
                "needed); export it alone, or scan more of the teeth that have not changed",
                other.name, jaw.name, 100.0 * placed.share, 100.0 * kLeastShare);
  }
  const Isometry& T_guess = placed.T_jaw_bite;
  const auto fit = evaluation::best_fit(evaluation::transformed(*other.surface, T_guess),
                                        *jaw.surface, {}, workers);
  if (!fit) return tl::unexpected(fit.error());
  return fit->T_truth_result * T_guess;
}

}  // namespace flytri::reconstruct
