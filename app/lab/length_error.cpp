#include "app/lab/length_error.h"

#include "core/evaluation/best_fit.h"

namespace flytri::lab {
namespace {

/// How the surface around a place must move to lie on the true one.
Result<Vec3> displacement_at(const TriangleMesh& scanned, const Vec3& p_mm,
                             const TriangleMesh& truth, const Workers& workers) {
  constexpr double kPatch_mm = 5.0;
  TriangleMesh patch;
  for (const SurfacePoint& vertex : scanned.vertices) {
    if ((vertex.position_mm.cast<double>() - p_mm).norm() < kPatch_mm) {
      patch.vertices.push_back(vertex);
    }
  }
  // Fewer points of a tooth do not determine where it is.
  constexpr std::size_t kLeastPoints = 100;
  if (patch.vertices.size() < kLeastPoints) {
    return fail(ErrorCode::kInsufficient,
                "only {} points were scanned within {} mm of ({:.1f}, {:.1f}, {:.1f}), at least {} "
                "are needed; scan more views",
                patch.vertices.size(), kPatch_mm, p_mm.x(), p_mm.y(), p_mm.z(), kLeastPoints);
  }
  const auto fit = evaluation::best_fit(patch, truth, {}, workers);
  if (!fit) return tl::unexpected(fit.error());
  return Vec3(fit->T_truth_result * p_mm - p_mm);
}

}  // namespace

Result<double> length_error_mm(const TriangleMesh& scanned, const TriangleMesh& truth,
                               const Vec3& from_mm, const Vec3& to_mm, const Workers& workers) {
  const auto at_from = displacement_at(scanned, from_mm, truth, workers);
  if (!at_from) return tl::unexpected(at_from.error());
  const auto at_to = displacement_at(scanned, to_mm, truth, workers);
  if (!at_to) return tl::unexpected(at_to.error());
  return (*at_from - *at_to).dot((to_mm - from_mm).normalized());
}

}  // namespace flytri::lab
