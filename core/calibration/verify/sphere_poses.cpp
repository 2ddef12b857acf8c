#include "core/calibration/verify/sphere_poses.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/median.h"
#include "core/geometry/decompositions.h"

namespace flytri::calibration {
namespace {

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
      const Vec3 out = outward(block, pose);
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

/// Where the sphere turns away from the camera, lines widen and leave the surface at one side.
bool is_steep(const VerificationBlock& block, const SpherePose& pose) {
  constexpr double kLeastFacing = 0.6;  // cosine of the angle between normal and view
  return -outward(block, pose).z() < kLeastFacing;
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

}  // namespace

double distance_off(const VerificationBlock& block, const SpherePose& pose, double radius_mm) {
  return (block.position_mm - pose.at(block.time)).norm() - radius_mm;
}

Vec3 outward(const VerificationBlock& block, const SpherePose& pose) {
  return (block.position_mm - pose.at(block.time)).normalized();
}

SphereData gather_spheres(std::vector<std::vector<VerificationBlock>> blocks_of_poses,
                          const std::vector<VerificationPose>& poses, double radius_mm) {
  constexpr std::size_t kMinBlocks = 30;
  SphereData data;
  data.blocks = std::move(blocks_of_poses);
  data.spheres.resize(poses.size());
  for (std::size_t p = 0; p < poses.size(); ++p) {
    auto& blocks = data.blocks[p];
    if (blocks.size() < kMinBlocks) {
      blocks.clear();
      continue;
    }
    data.spheres[p] = find_sphere(blocks, radius_mm, poses[p].moves);
    std::erase_if(blocks,
                  [&](const VerificationBlock& block) { return is_steep(block, data.spheres[p]); });
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

Eigen::MatrixXd rows_of_center(const std::vector<VerificationBlock>& blocks, const SpherePose& pose,
                               bool moves) {
  Eigen::MatrixXd rows(static_cast<Eigen::Index>(blocks.size()), moves ? 6 : 3);
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    const VerificationBlock& block = blocks[static_cast<std::size_t>(i)];
    const Vec3 out = outward(block, pose);
    rows.row(i).head<3>() = out;
    if (moves) rows.row(i).tail<3>() = block.time * out;
  }
  return rows;
}

}  // namespace flytri::calibration
