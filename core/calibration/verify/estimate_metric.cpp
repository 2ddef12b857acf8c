#include "core/calibration/verify/estimate_metric.h"

#include "core/calibration/verify/sphere_poses.h"

namespace flytri::calibration {
namespace {

/// The same for all poses: two shears, and the depth between vertical and horizontal lines, which a
/// bumped projector changes.
constexpr Eigen::Index kMetricUnknowns = 3;

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
      shared.row(i) << out.x() * at.z(), out.y() * at.z(), block.sign * out.z();
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
    // One shear after another is the shear by their sum.
    estimate.correction.shear += solution->shared.head<2>();
    estimate.uncertainty = solution->uncertainty.head<2>();
  }
  return estimate;
}

}  // namespace flytri::calibration
