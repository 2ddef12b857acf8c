#include "core/live/surface_sums.h"

#include "core/geometry/decompositions.h"

namespace flytri::live {
namespace {

/// If the second eigenvalue is below this share of the largest, all profiles run in one direction.
constexpr float kCrossingShare = 0.05F;

}  // namespace

Vec3f normal_of(const DirectionSums& sums) {
  const Vec3f towards = sums.towards.cast<float>();
  const auto axes = direct_symmetric_eigen(Eigen::Matrix3f(matrix_of(sums.tangents)));
  Vec3f normal = axes.vectors.col(0);
  if (axes.values[1] < kCrossingShare * axes.values[2]) {
    const Vec3f along = axes.vectors.col(2);
    normal = (towards - towards.dot(along) * along).normalized();
  }
  return normal.dot(towards) < 0.0F ? Vec3f(-normal) : normal;
}

}  // namespace flytri::live
