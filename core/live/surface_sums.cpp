#include "core/live/surface_sums.h"

#include <Eigen/Eigenvalues>

namespace flytri::live {
namespace {

/// If the second eigenvalue is below this share of the largest, all profiles run in one direction.
constexpr float kCrossingShare = 0.05F;

}  // namespace

Vec3f normal_of(const DirectionSums& sums) {
  const Vec3f towards = sums.towards.cast<float>();
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> solver;
  solver.computeDirect(matrix_of(sums.tangents));
  Vec3f normal = solver.eigenvectors().col(0);
  if (solver.eigenvalues()[1] < kCrossingShare * solver.eigenvalues()[2]) {
    const Vec3f along = solver.eigenvectors().col(2);
    normal = (towards - towards.dot(along) * along).normalized();
  }
  return normal.dot(towards) < 0.0F ? Vec3f(-normal) : normal;
}

}  // namespace flytri::live
