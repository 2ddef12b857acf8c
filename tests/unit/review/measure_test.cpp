#include "core/review/measure.h"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "core/base/random.h"
#include "core/geometry/sphere_mesh.h"

namespace flytri::review {
namespace {

using ::testing::DoubleNear;

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// The spread of a number when its points have noise.
double spread_by_noise(const std::vector<MeasuredPoint>& points,
                       const std::function<double(const std::vector<MeasuredPoint>&)>& number) {
  Random random(7);
  const double without = number(points);
  double squares = 0.0;
  constexpr int kTrials = 20000;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::vector<MeasuredPoint> noisy = points;
    for (MeasuredPoint& point : noisy)
      point.position_mm += point.sigma_mm * Vec3(random.normal(), random.normal(), random.normal());
    const double change = number(noisy) - without;
    squares += change * change;
  }
  return std::sqrt(squares / kTrials);
}

TEST(Measure, UncertaintyOfADistanceIsItsSpreadByNoise) {
  const std::vector<MeasuredPoint> points = {{{1.0, 2.0, 3.0}, 0.02}, {{4.0, -2.0, 3.5}, 0.03}};
  const Measured distance = distance_mm(points[0], points[1]);
  EXPECT_THAT(distance.value, DoubleNear(std::sqrt(9.0 + 16.0 + 0.25), 1e-12));
  EXPECT_THAT(distance.uncertainty, DoubleNear(std::hypot(0.02, 0.03), 1e-12));
  const double spread = spread_by_noise(
      points, [](const std::vector<MeasuredPoint>& p) { return distance_mm(p[0], p[1]).value; });
  EXPECT_NEAR(distance.uncertainty / spread, 1.0, 0.03);
}

TEST(Measure, UncertaintyOfAnAngleIsItsSpreadByNoise) {
  const std::vector<MeasuredPoint> points = {
      {{3.0, 0.0, 0.0}, 0.02}, {{0.0, 0.0, 0.0}, 0.01}, {{1.0, 2.0, 0.5}, 0.03}};
  const Measured angle = angle_rad(points[0], points[1], points[2]);
  EXPECT_NEAR(angle.value, std::acos(1.0 / std::sqrt(5.25)), 1e-12);
  const double spread = spread_by_noise(points, [](const std::vector<MeasuredPoint>& p) {
    return angle_rad(p[0], p[1], p[2]).value;
  });
  EXPECT_NEAR(angle.uncertainty / spread, 1.0, 0.03);
}

TEST(Measure, AnAngleWithoutTwoDirectionsIsUnknown) {
  const MeasuredPoint a{{1.0, 0.0, 0.0}, 0.01}, b{{2.0, 0.0, 0.0}, 0.01};
  EXPECT_EQ(angle_rad(a, a, b).uncertainty, kInfinite);
  EXPECT_NEAR(angle_rad(a, {{1.5, 0.0, 0.0}, 0.01}, b).value, std::numbers::pi, 1e-12);
}

TEST(Measure, APointOnTheSurfaceHasTheSigmaBetweenItsCorners) {
  TriangleMesh mesh;
  mesh.vertices.resize(3);
  mesh.vertices[1].position_mm = {1.0F, 0.0F, 0.0F};
  mesh.vertices[2].position_mm = {0.0F, 1.0F, 0.0F};
  for (const std::size_t i : {0U, 1U, 2U})
    mesh.vertices[i].sigma_mm = 0.01F * static_cast<float>(i + 1);
  mesh.triangles = {{0, 1, 2}};
  EXPECT_TRUE(has_uncertainty(mesh));
  const MeshDistance distance(mesh);
  const MeasuredPoint point = point_on_surface(mesh, distance, {0.25, 0.25, 0.7});
  EXPECT_LT((point.position_mm - Vec3(0.25, 0.25, 0.0)).norm(), 1e-6);
  EXPECT_NEAR(point.sigma_mm, 0.5 * 0.01 + 0.25 * 0.02 + 0.25 * 0.03, 1e-6);
  // A corner that nobody measured counts only where it has a share.
  mesh.vertices[2].sigma_mm = std::numeric_limits<float>::infinity();
  EXPECT_EQ(point_on_surface(mesh, distance, {0.25, 0.25, 0.0}).sigma_mm, kInfinite);
  EXPECT_NEAR(point_on_surface(mesh, distance, {0.5, 0.0, 0.0}).sigma_mm, 0.015, 1e-6);
  set_uncertainty(mesh, 0.05);
  EXPECT_NEAR(point_on_surface(mesh, distance, {0.5, 0.0, 0.0}).sigma_mm, 0.05, 1e-6);
  EXPECT_EQ(point_on_surface(mesh, distance, {0.25, 0.25, 0.0}).sigma_mm, kInfinite);
}

TEST(Measure, AMeshOfAnotherProgramHasNoUncertainty) {
  EXPECT_FALSE(has_uncertainty(sphere_mesh(Vec3::Zero(), 1.0, 4)));
}

}  // namespace
}  // namespace flytri::review
