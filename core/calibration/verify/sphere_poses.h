/// @file  Finds a sphere of known size in the views of each pose.
#pragma once

#include <vector>

#include "core/calibration/verify/verification_blocks.h"

namespace flytri::calibration {

/// Center of the sphere at the middle of the pose, and its motion until the end of the pose.
struct SpherePose {
  Vec3 center_mm = Vec3::Zero();
  Vec3 motion_mm = Vec3::Zero();
  [[nodiscard]] Vec3 at(double time) const { return center_mm + time * motion_mm; }
};

struct SphereData {
  std::vector<std::vector<VerificationBlock>> blocks;  ///< by pose, on the sphere; empty: not seen
  std::vector<SpherePose> spheres;                     ///< by pose
  std::size_t found = 0;                               ///< blocks of all poses
  std::size_t kept = 0;                                ///< those on the sphere
};

/// Signed distance of a block from the sphere, mm.
[[nodiscard]] double distance_off(const VerificationBlock& block, const SpherePose& pose,
                                  double radius_mm);
/// Unit vector from the center to the block.
[[nodiscard]] Vec3 outward(const VerificationBlock& block, const SpherePose& pose);

/// @param blocks  by pose, as cut_blocks gives them
[[nodiscard]] SphereData gather_spheres(std::vector<std::vector<VerificationBlock>> blocks,
                                        const std::vector<VerificationPose>& poses,
                                        double radius_mm);

/// Derivatives of the distances by the center and, if it moves, the motion of the sphere.
[[nodiscard]] Eigen::MatrixXd rows_of_center(const std::vector<VerificationBlock>& blocks,
                                             const SpherePose& pose, bool moves);

}  // namespace flytri::calibration
