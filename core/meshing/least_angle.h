/// @file  The smallest angle of a triangle, by which slivers are told.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>

namespace flytri::meshing {

/// Its sine; 0 for a triangle without area. The two longer sides enclose the angle.
template <typename Scalar>
[[nodiscard]] Scalar sine_of_least_angle(const Eigen::Matrix<Scalar, 3, 1>& a,
                                         const Eigen::Matrix<Scalar, 3, 1>& b,
                                         const Eigen::Matrix<Scalar, 3, 1>& c) {
  const Scalar ab = (b - a).norm(), bc = (c - b).norm(), ca = (a - c).norm();
  const Scalar product = ab * bc * ca;
  return product > 0 ? (b - a).cross(c - a).norm() * std::min({ab, bc, ca}) / product : Scalar(0);
}

}  // namespace flytri::meshing
