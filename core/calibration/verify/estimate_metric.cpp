#include "core/calibration/verify/estimate_metric.h"

#include "core/calibration/verify/sphere_poses.h"

namespace flytri::calibration {
namespace {

/// The same for all poses: two scales (lateral, depth), two shears, and the depth between vertical
/// and horizontal lines. A bumped projector changes the last.
constexpr Eigen::Index kMetricUnknowns = 5;

/// The map is linear in its numbers; the spheres are found anew after each step.
constexpr int kSteps = 4;

SharedFit fit_of(const SphereData& data, const std::vector<VerificationPose>& poses,
                 double radius_mm) {
  SharedFit fit(kMetricUnknowns);
  for (std::size_t p = 0; p < poses.size(); ++p) {
    const auto& blocks = data.blocks[p];
    if (blocks.empty()) continue;
    const SpherePose& sphere = data.spheres[p];
    const auto rows = static_cast<Eigen::Index>(blocks.size());
    Eigen::MatrixXd shared(rows, kMetricUnknowns);
    Eigen::VectorXd values(rows);
    for (Eigen::Index i = 0; i < rows; ++i) {
      const VerificationBlock& block = blocks[static_cast<std::size_t>(i)];
      const Vec3 out = outward(block, sphere);
      const Vec3& at = block.position_mm;
      shared.row(i) << out.x() * at.x() + out.y() * at.y(), out.z() * at.z(), out.x() * at.z(),
          out.y() * at.z(), block.sign * out.z();
      values[i] = -distance_off(block, sphere, radius_mm);
    }
    fit.add_pose(shared, rows_of_center(blocks, sphere, poses[p].moves), values,
                 clusters_of(blocks, poses[p].moves));
  }
  return fit;
}

std::vector<std::vector<VerificationBlock>> mapped(
    std::vector<std::vector<VerificationBlock>> blocks, const Eigen::Matrix3d& map) {
  for (auto& of_pose : blocks) {
    for (VerificationBlock& block : of_pose) block.position_mm = map * block.position_mm;
  }
  return blocks;
}

/// The map that first makes `before`, then changes the result by these numbers.
MetricCorrection after(const MetricCorrection& before, const Eigen::VectorXd& change) {
  MetricCorrection step;
  step.lateral += change[0];
  step.depth += change[1];
  step.shear = change.segment<2>(2);
  const Eigen::Matrix3d map = step.matrix() * before.matrix();
  return {map(0, 0), map(2, 2), map.topRightCorner<2, 1>()};
}

}  // namespace

Result<MetricEstimate> estimate_metric(const std::vector<VerificationPose>& poses,
                                       double diameter_mm) {
  const double radius_mm = 0.5 * diameter_mm;
  const auto blocks = cut_blocks(poses);
  MetricEstimate estimate;
  for (int step = 0; step < kSteps; ++step) {
    const SphereData data =
        gather_spheres(mapped(blocks, estimate.correction.matrix()), poses, radius_mm);
    const auto solution = fit_of(data, poses, radius_mm).solve();
    if (!solution)
      return fail(ErrorCode::kInsufficient,
                  "the sphere was hardly seen; hold it at several depths and at the sides");
    estimate.correction = after(estimate.correction, solution->shared);
    const Eigen::VectorXd& sigma = solution->uncertainty;
    estimate.uncertainty = {sigma[0], sigma[1], sigma.segment<2>(2)};
  }
  return estimate;
}

}  // namespace flytri::calibration
