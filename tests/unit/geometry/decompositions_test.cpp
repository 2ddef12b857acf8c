#include "core/geometry/decompositions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace flytri {
namespace {

Matrix6 positive_matrix() {
  Matrix6 root;
  for (int i = 0; i < 36; ++i) root(i / 6, i % 6) = std::sin(1.0 + i * i);
  return root * root.transpose() + Matrix6::Identity();
}

TEST(SymmetricEigen, ValuesAndVectorsGiveTheMatrix) {
  const Matrix6 A = positive_matrix();
  const auto eigen = symmetric_eigen(A);
  EXPECT_TRUE(A.isApprox(eigen.vectors * eigen.values.asDiagonal() * eigen.vectors.transpose()));
  EXPECT_TRUE(std::is_sorted(eigen.values.begin(), eigen.values.end()));
}

TEST(SymmetricEigen, TheClosedFormAgreesWithTheIteration) {
  const Eigen::Matrix3d A = positive_matrix().topLeftCorner<3, 3>();
  const auto eigen = symmetric_eigen(A), direct = direct_symmetric_eigen(A);
  EXPECT_TRUE(direct.values.isApprox(eigen.values, 1e-9));
  EXPECT_TRUE(symmetric_eigenvalues(A.cast<float>()).isApprox(eigen.values.cast<float>(), 1e-5F));
}

TEST(SolveSymmetric, SolvesAndReadsTheLowerTriangleAlone) {
  const Matrix6 A = positive_matrix();
  Matrix6 lower = A;
  lower.triangularView<Eigen::StrictlyUpper>().setConstant(1e9);
  const Twist x = Twist::LinSpaced(1.0, 6.0);
  EXPECT_TRUE(solve_symmetric(lower, A * x).isApprox(x, 1e-9));
  EXPECT_TRUE((inverse_of_symmetric(A) * A).isIdentity(1e-9));
}

TEST(SolveSymmetric, RefusesASmallPivot) {
  Matrix6 A = Matrix6::Identity();
  A(5, 5) = 1e-10;
  EXPECT_FALSE(solve_symmetric(A, Twist::Ones(), 1e-9).has_value());
  EXPECT_TRUE(solve_symmetric(A, Twist::Ones(), 1e-11).has_value());
}

TEST(SolveLeastSquares, FindsCoefficientsAndRank) {
  Eigen::MatrixXd A(20, 3);
  for (Eigen::Index i = 0; i < A.rows(); ++i) {
    const auto t = static_cast<double>(i);
    A.row(i) << 1.0, t, t * t;
  }
  const Eigen::Vector3d x(3.0, -2.0, 0.5);
  const LeastSquares fit = solve_least_squares(A, A * x);
  EXPECT_TRUE(fit.x.isApprox(x, 1e-9));
  EXPECT_EQ(fit.rank, 3);
  EXPECT_TRUE(solve_each_least_squares(A, A * x).isApprox(x, 1e-9));
  EXPECT_TRUE(solve_each_regular(A, A * x).isApprox(x, 1e-9));
  A.col(2) = A.col(1);
  EXPECT_EQ(solve_least_squares(A, A * x).rank, 2);
}

TEST(BestMotion, FindsTheMotionAlsoOfFlatPoints) {
  const Isometry T_a_b = make_isometry(Eigen::Quaterniond(0.3, 0.8, -0.4, 0.2), Vec3(5, -3, 40));
  std::vector<Vec3> points_b = {{0, 0, 0}, {10, 0, 0}, {0, 7, 0}, {10, 7, 0}}, points_a;
  for (const Vec3& p : points_b) points_a.emplace_back(T_a_b * p);
  EXPECT_TRUE(best_motion(points_b, points_a).isApprox(T_a_b, 1e-9));
  points_b.emplace_back(1, 2, 30);
  points_a.emplace_back(T_a_b * points_b.back());
  EXPECT_TRUE(best_motion(points_b, points_a).isApprox(T_a_b, 1e-9));
}

TEST(BestMotion, OfMirroredPointsIsNoReflection) {
  const std::vector<Vec3> points = {{0, 0, 0}, {9, 0, 0}, {0, 5, 0}, {0, 0, 1}};
  std::vector<Vec3> mirrored = points;
  for (Vec3& p : mirrored) p.z() = -p.z();
  EXPECT_NEAR(best_motion(points, mirrored).linear().determinant(), 1.0, 1e-12);
}

}  // namespace
}  // namespace flytri
