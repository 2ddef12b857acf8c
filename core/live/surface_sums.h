/// @file  Sums over the points of a cell. They come out the same in any order of the points, and a
/// part of them can be taken away again without a trace.
#pragma once

#include <cstdint>

#include "core/geometry/rigid.h"

namespace flytri::live {

/// Rounds to a multiple of 2^-kBits. Sums of such numbers are exact up to 2^(53 - kBits).
/// @param x  of less than 2^(51 - kBits); of larger numbers, fewer bits are kept
template <int kBits>
[[nodiscard]] double rounded(double x) {
  constexpr double kShift = 3.0 * static_cast<double>(std::uint64_t{1} << (51 - kBits));
  return (x + kShift) - kShift;
}

/// A sum of symmetric matrices: xx, yy, zz, xy, xz, yz.
using SymmetricSum = Eigen::Matrix<double, 6, 1>;

/// v v^T times a factor, rounded.
template <int kBits>
[[nodiscard]] SymmetricSum rounded_square(const Vec3f& v_single, double factor = 1.0) {
  const Vec3 v = v_single.cast<double>();
  const Vec3 scaled = factor * v;
  SymmetricSum square;
  square << scaled.x() * v.x(), scaled.y() * v.y(), scaled.z() * v.z(), scaled.x() * v.y(),
      scaled.x() * v.z(), scaled.y() * v.z();
  return square.unaryExpr([](double x) { return rounded<kBits>(x); });
}

[[nodiscard]] inline Eigen::Matrix3f matrix_of(const SymmetricSum& sum) {
  Eigen::Matrix3d matrix;
  matrix << sum[0], sum[3], sum[4], sum[3], sum[1], sum[5], sum[4], sum[5], sum[2];
  return matrix.cast<float>();
}

/// What the normal follows from.
struct DirectionSums {
  SymmetricSum tangents = SymmetricSum::Zero();  ///< sum of o o^T
  Vec3 towards = Vec3::Zero();                   ///< sum of directions to the sensor

  DirectionSums& operator+=(const DirectionSums& other) {
    tangents += other.tangents;
    towards += other.towards;
    return *this;
  }
  DirectionSums& operator-=(const DirectionSums& other) {
    tangents -= other.tangents;
    towards -= other.towards;
    return *this;
  }
};

/// The direction most perpendicular to all profiles, towards the sensor. Parallel profiles leave a
/// choice: then the perpendicular that faces the sensor most.
[[nodiscard]] Vec3f normal_of(const DirectionSums& sums);

/// What a cell knows of its points.
struct CellSums {
  std::uint32_t point_count = 0;
  Vec3 offset_mm = Vec3::Zero();  ///< of the positions from the center of the cell
  /// Covariance of the sum of all points, world frame.
  SymmetricSum covariance_mm2 = SymmetricSum::Zero();
  DirectionSums directions;

  CellSums& operator+=(const CellSums& other) {
    point_count += other.point_count;
    offset_mm += other.offset_mm;
    covariance_mm2 += other.covariance_mm2;
    directions += other.directions;
    return *this;
  }
  CellSums& operator-=(const CellSums& other) {
    point_count -= other.point_count;
    offset_mm -= other.offset_mm;
    covariance_mm2 -= other.covariance_mm2;
    directions -= other.directions;
    return *this;
  }
};

}  // namespace flytri::live
