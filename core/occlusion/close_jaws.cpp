#include "core/occlusion/close_jaws.h"

namespace flytri::occlusion {
namespace {

Vec3 least_certain_mm(const Occlusion& occlusion, const TriangleMesh& lower) {
  Vec3 worst_mm = occlusion.middle_mm;
  double largest_mm = 0.0;
  for (const SurfacePoint& vertex : lower.vertices) {
    const Vec3 p_mm = occlusion.T_upper_lower * vertex.position_mm.cast<double>();
    const double uncertainty_mm = occlusion.uncertainty_mm(p_mm);
    if (uncertainty_mm <= largest_mm) continue;
    largest_mm = uncertainty_mm;
    worst_mm = p_mm;
  }
  return worst_mm;
}

}  // namespace

Result<ClosedJaws> close_jaws(const TriangleMesh& upper, const TriangleMesh& lower,
                              std::span<const BiteScan> bites, const OccludeOptions& options,
                              const Workers& workers, const Progress& progress) {
  auto found = find_occlusion(upper, lower, bites, options, workers, progress);
  if (!found) return tl::unexpected(found.error());
  ClosedJaws jaws;
  jaws.occlusion = *std::move(found);
  const Isometry& T_upper_lower = jaws.occlusion.T_upper_lower;
  jaws.lower = find_clearance(lower, JawSurface(upper), T_upper_lower, kClearanceLimit_mm, workers);
  jaws.upper = find_clearance(upper, JawSurface(lower), T_upper_lower.inverse(), kClearanceLimit_mm,
                              workers);
  jaws.least_certain_mm = least_certain_mm(jaws.occlusion, lower);
  return jaws;
}

}  // namespace flytri::occlusion
