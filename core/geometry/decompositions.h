/// @file  Decompositions of dense matrices, as plain functions: Eigen's templates of them take
/// seconds to compile in each file that uses them.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "core/geometry/rigid.h"

namespace flytri {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// A = sum of values[i] * vectors.col(i) * vectors.col(i)^T.
template <typename Matrix>
struct SymmetricEigen {
  Eigen::Matrix<typename Matrix::Scalar, Matrix::RowsAtCompileTime, 1> values;  ///< rising
  Matrix vectors;  ///< orthonormal, in columns
};

/// Iterative, to full accuracy. Only the lower triangle is read.
[[nodiscard]] SymmetricEigen<Eigen::Matrix3d> symmetric_eigen(const Eigen::Matrix3d& A);
[[nodiscard]] SymmetricEigen<Matrix6> symmetric_eigen(const Matrix6& A);
[[nodiscard]] SymmetricEigen<Eigen::MatrixXd> symmetric_eigen(const Eigen::MatrixXd& A);
/// The values alone.
[[nodiscard]] Vec3f symmetric_eigenvalues(const Eigen::Matrix3f& A);

/// In closed form: several times as fast, and less accurate for values that are nearly equal.
[[nodiscard]] SymmetricEigen<Eigen::Matrix3f> direct_symmetric_eigen(const Eigen::Matrix3f& A);
[[nodiscard]] SymmetricEigen<Eigen::Matrix3d> direct_symmetric_eigen(const Eigen::Matrix3d& A);

/// x of A x = b for a symmetric positive A (LDLT). Only the lower triangle is read.
[[nodiscard]] Twist solve_symmetric(const Matrix6& A, const Twist& b);
/// The same; nothing if a pivot is at most this share of the largest one.
[[nodiscard]] std::optional<Twist> solve_symmetric(const Matrix6& A, const Twist& b,
                                                   double min_pivot_share);
/// The inverse of a symmetric positive A (LDLT).
[[nodiscard]] Matrix6 inverse_of_symmetric(const Matrix6& A);

/// The x for which |A x - b| is least, and how many of its entries A determines (QR with pivots).
struct LeastSquares {
  Eigen::VectorXd x;
  Eigen::Index rank = 0;
};
[[nodiscard]] LeastSquares solve_least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);
/// For each column of B.
[[nodiscard]] Eigen::MatrixXd solve_each_least_squares(const Eigen::MatrixXd& A,
                                                       const Eigen::MatrixXd& B);
/// For each column of B and an A that determines all entries: faster, without pivots.
[[nodiscard]] Eigen::MatrixXd solve_each_regular(const Eigen::MatrixXd& A,
                                                 const Eigen::MatrixXd& B);

/// The rigid motion that brings points closest to others, in the sum of squares. As many of both,
/// at least one.
/// @source  Umeyama, "Least-squares estimation of transformation parameters", 1991.
[[nodiscard]] Isometry best_motion(std::span<const Vec3> points_b_mm,
                                   std::span<const Vec3> points_a_mm);

}  // namespace flytri
