#include "core/geometry/decompositions.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <cassert>

namespace flytri {
namespace {

template <typename Matrix>
SymmetricEigen<Matrix> iterative(const Matrix& A) {
  const Eigen::SelfAdjointEigenSolver<Matrix> solver(A);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

template <typename Matrix>
SymmetricEigen<Matrix> direct(const Matrix& A) {
  Eigen::SelfAdjointEigenSolver<Matrix> solver;
  solver.computeDirect(A);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

}  // namespace

SymmetricEigen<Eigen::Matrix3d> symmetric_eigen(const Eigen::Matrix3d& A) { return iterative(A); }
SymmetricEigen<Matrix6> symmetric_eigen(const Matrix6& A) { return iterative(A); }
SymmetricEigen<Eigen::MatrixXd> symmetric_eigen(const Eigen::MatrixXd& A) { return iterative(A); }

Vec3f symmetric_eigenvalues(const Eigen::Matrix3f& A) {
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f>(A).eigenvalues();
}

SymmetricEigen<Eigen::Matrix3f> direct_symmetric_eigen(const Eigen::Matrix3f& A) {
  return direct(A);
}
SymmetricEigen<Eigen::Matrix3d> direct_symmetric_eigen(const Eigen::Matrix3d& A) {
  return direct(A);
}

Twist solve_symmetric(const Matrix6& A, const Twist& b) { return A.ldlt().solve(b); }

std::optional<Twist> solve_symmetric(const Matrix6& A, const Twist& b, double min_pivot_share) {
  const Eigen::LDLT<Matrix6> solver(A);
  const auto pivots = solver.vectorD();
  if (pivots.minCoeff() <= min_pivot_share * pivots.maxCoeff()) return std::nullopt;
  return solver.solve(b);
}

Matrix6 inverse_of_symmetric(const Matrix6& A) { return A.ldlt().solve(Matrix6::Identity()); }

LeastSquares solve_least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(A);
  return {qr.solve(b), qr.rank()};
}

Eigen::MatrixXd solve_each_least_squares(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
  return A.colPivHouseholderQr().solve(B);
}

Eigen::MatrixXd solve_each_regular(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
  return A.householderQr().solve(B);
}

Isometry best_motion(std::span<const Vec3> points_b_mm, std::span<const Vec3> points_a_mm) {
  assert(!points_b_mm.empty() && points_b_mm.size() == points_a_mm.size());
  const auto count = static_cast<double>(points_b_mm.size());
  Vec3 mean_b_mm = Vec3::Zero(), mean_a_mm = Vec3::Zero();
  for (const Vec3& p : points_b_mm) mean_b_mm += p / count;
  for (const Vec3& p : points_a_mm) mean_a_mm += p / count;
  Eigen::Matrix3d products = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < points_b_mm.size(); ++i) {
    products += (points_a_mm[i] - mean_a_mm) * (points_b_mm[i] - mean_b_mm).transpose();
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(products, Eigen::ComputeFullU | Eigen::ComputeFullV);
  // The best orthogonal matrix may be a reflection.
  const double sign = (svd.matrixU() * svd.matrixV()).determinant() < 0.0 ? -1.0 : 1.0;
  Isometry T_a_b = Isometry::Identity();
  T_a_b.linear() = svd.matrixU() * Vec3(1.0, 1.0, sign).asDiagonal() * svd.matrixV().transpose();
  T_a_b.translation() = mean_a_mm - T_a_b.linear() * mean_b_mm;
  return T_a_b;
}

}  // namespace flytri
