#include <algorithm>
#include <cmath>

#include "core/base/median.h"
#include "core/calibration/verify/verification_blocks.h"
#include "core/calibration/verify/verify.h"
#include "core/geometry/decompositions.h"

namespace flytri::calibration {
namespace {

/// Shared unknowns: error of the radius, and depth of vertical minus horizontal.
constexpr Eigen::Index kShared = 2;

/// Center of the sphere at the middle of the pose, and its motion until the end of the pose.
struct SpherePose {
  Vec3 center_mm = Vec3::Zero();
  Vec3 motion_mm = Vec3::Zero();
  [[nodiscard]] Vec3 at(double time) const { return center_mm + time * motion_mm; }
};

/// Start value: the nearest point is on the near side of the sphere.
SpherePose first_guess(const std::vector<VerificationBlock>& blocks, double radius_mm) {
  SpherePose pose;
  const auto nearest = std::min_element(blocks.begin(), blocks.end(),
                                        [](const VerificationBlock& a, const VerificationBlock& b) {
                                          return a.position_mm.z() < b.position_mm.z();
                                        });
  pose.center_mm = nearest->position_mm + radius_mm * Vec3::UnitZ();
  return pose;
}

double distance_off(const VerificationBlock& block, const SpherePose& pose, double radius_mm) {
  return (block.position_mm - pose.at(block.time)).norm() - radius_mm;
}

/// Robust standard deviation of the distances from the sphere, mm.
double spread_off(const std::vector<VerificationBlock>& blocks, const SpherePose& pose,
                  double radius_mm) {
  std::vector<double> sizes;
  sizes.reserve(blocks.size());
  for (const VerificationBlock& block : blocks) {
    sizes.push_back(std::abs(distance_off(block, pose, radius_mm)));
  }
  return kSigmaOfMedian * median_of(sizes);
}

/// Gauss-Newton for center and motion only, with weights that decrease with the distance from the
/// sphere.
SpherePose find_sphere(const std::vector<VerificationBlock>& blocks, double radius_mm, bool moves) {
  constexpr int kRounds = 30;
  SpherePose pose = first_guess(blocks, radius_mm);
  const auto rows = static_cast<Eigen::Index>(blocks.size());
  for (int round = 0; round < kRounds; ++round) {
    const double sigma_mm = std::max(spread_off(blocks, pose, radius_mm), 1e-9);
    Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(rows, moves ? 6 : 3);
    Eigen::VectorXd off(rows);
    for (Eigen::Index i = 0; i < rows; ++i) {
      const VerificationBlock& block = blocks[static_cast<std::size_t>(i)];
      const Vec3 out = (block.position_mm - pose.at(block.time)).normalized();
      const double size = distance_off(block, pose, radius_mm);
      const double weight = 1.0 / std::hypot(1.0, size / sigma_mm);
      jacobian.row(i).head<3>() = weight * out;
      if (moves) jacobian.row(i).tail<3>() = weight * block.time * out;
      off[i] = weight * size;
    }
    const Eigen::VectorXd step = solve_least_squares(jacobian, off).x;
    pose.center_mm += step.head<3>();
    if (moves) pose.motion_mm += step.tail<3>();
  }
  return pose;
}

std::vector<VerificationBlock> on_sphere(const std::vector<VerificationBlock>& blocks,
                                         const SpherePose& pose, double radius_mm) {
  constexpr double kOutlier = 6.0;  // robust deviations
  const double limit_mm = kOutlier * spread_off(blocks, pose, radius_mm);
  std::vector<VerificationBlock> kept;
  for (const VerificationBlock& block : blocks) {
    if (std::abs(distance_off(block, pose, radius_mm)) < limit_mm) kept.push_back(block);
  }
  return kept;
}

/// Adds the distances from the sphere of known radius and their derivatives to the fit.
void add_pose(SharedFit& fit, const std::vector<VerificationBlock>& blocks, const SpherePose& pose,
              double radius_mm, bool moves, bool as_bent) {
  const auto rows = static_cast<Eigen::Index>(blocks.size());
  Eigen::MatrixXd shared(rows, kShared), own = Eigen::MatrixXd::Zero(rows, moves ? 6 : 3);
  Eigen::VectorXd values(rows);
  std::vector<std::size_t> clusters;
  for (Eigen::Index i = 0; i < rows; ++i) {
    const VerificationBlock& block = blocks[static_cast<std::size_t>(i)];
    const Vec3 from_center = block.position_mm - pose.at(block.time);
    const Vec3 out = from_center.normalized();
    shared.row(i) << 1.0, block.sign * out.z();
    own.row(i).head<3>() = out;
    if (moves) own.row(i).tail<3>() = block.time * out;
    const double aside = from_center.head<2>().squaredNorm() / (radius_mm * radius_mm);
    values[i] = as_bent ? out.z() * aside : distance_off(block, pose, radius_mm);
    clusters.push_back(moves ? 0 : block.line);
  }
  fit.add_pose(shared, own, values, clusters);
}

struct SphereData {
  std::vector<std::vector<VerificationBlock>> blocks;  // by pose
  std::vector<SpherePose> spheres;                     // by pose
  std::size_t found = 0, kept = 0;
};

SphereData gather_spheres(const std::vector<VerificationPose>& poses, double radius_mm) {
  constexpr std::size_t kMinBlocks = 30;
  SphereData data;
  data.blocks = cut_blocks(poses);
  data.spheres.resize(poses.size());
  for (std::size_t p = 0; p < poses.size(); ++p) {
    auto& blocks = data.blocks[p];
    data.found += blocks.size();
    if (blocks.size() < kMinBlocks) {
      blocks.clear();
      continue;
    }
    data.spheres[p] = find_sphere(blocks, radius_mm, poses[p].moves);
    blocks = on_sphere(blocks, data.spheres[p], radius_mm);
    data.kept += blocks.size();
  }
  return data;
}

std::optional<SharedFit::Solution> solve_spheres(const SphereData& data,
                                                 const std::vector<VerificationPose>& poses,
                                                 double radius_mm, bool as_bent) {
  SharedFit fit(kShared);
  for (std::size_t p = 0; p < poses.size(); ++p) {
    if (data.blocks[p].empty()) continue;
    add_pose(fit, data.blocks[p], data.spheres[p], radius_mm, poses[p].moves, as_bent);
  }
  return fit.solve();
}

}  // namespace

Result<VerificationReport> check_on_sphere(const std::vector<VerificationPose>& poses,
                                           double diameter_mm, const Calibration& calibration,
                                           const VerificationOptions& options) {
  if (auto valid = options.validate(); !valid) return tl::unexpected(valid.error());
  if (!(diameter_mm > 0.0)) {
    return fail(ErrorCode::kBadOption, "the sphere's diameter is {} mm, but must be above 0",
                diameter_mm);
  }
  const double radius_mm = 0.5 * diameter_mm;
  const SphereData data = gather_spheres(poses, radius_mm);
  VerificationReport report;
  if (static_cast<double>(data.kept) < options.min_share_on_object * double(data.found)) {
    report.reason = "too many measured points are not on the sphere; nothing else may be in view";
    return report;
  }
  const auto solution = solve_spheres(data, poses, radius_mm, false);
  const auto bent = solve_spheres(data, poses, radius_mm, true);
  if (!solution || !bent) {
    report.reason = "the sphere was hardly seen; hold it in the middle of the volume";
    return report;
  }
  // Change of the diameter if the calibration is bent by its residual.
  const double diameter_residual_mm =
      2.0 * std::abs(bent->shared[0]) * residual_mm(calibration, false);
  report.figures = {
      make_figure(VerificationSymptom::kDiameter, "diameter", 2.0 * solution->shared[0],
                  2.0 * solution->uncertainty[0], diameter_residual_mm, options),
      make_figure(VerificationSymptom::kOffset, "vertical minus horizontal", solution->shared[1],
                  solution->uncertainty[1], residual_mm(calibration, true), options),
      form_figure(data.blocks, solution->residuals, calibration, options)};
  judge(report, calibration.volume, options);
  return report;
}

}  // namespace flytri::calibration
