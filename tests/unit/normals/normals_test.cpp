#include "core/normals/normals.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/scan_scene.h"

namespace flytri::normals {
namespace {

using testing::scan_cusps;
using testing::SceneSensor;

constexpr double kDegree = M_PI / 180.0;

/// Normal of the surface with cusps, towards the sensor (-z).
Vec3 true_normal(const Vec3& p_model) {
  constexpr double kStep = 1e-4;
  const auto z = testing::cusped_height;
  const double dx =
      (z(p_model.x() + kStep, p_model.y()) - z(p_model.x() - kStep, p_model.y())) / (2 * kStep);
  const double dy =
      (z(p_model.x(), p_model.y() + kStep) - z(p_model.x(), p_model.y() - kStep)) / (2 * kStep);
  return Vec3(dx, dy, -1.0).normalized();
}

/// Angles between estimated and true normals. The scan's first pose is the frame of the model.
std::vector<double> angle_errors(const std::vector<AlignedView>& views,
                                 const std::vector<ViewNormals>& normals) {
  std::vector<double> errors;
  for (std::size_t v = 0; v < views.size(); ++v) {
    const auto& profiles = views[v].view->profiles;
    for (std::size_t k = 0; k < profiles.size(); ++k) {
      for (std::size_t i = 0; i < profiles[k].points.size(); ++i) {
        const Vec3 n = normals[v][k][i].cast<double>();
        const Vec3 truth = true_normal(views[v].T_world_sensor * profiles[k].points[i].position_mm);
        errors.push_back(std::acos(std::clamp(n.dot(truth), -1.0, 1.0)));
      }
    }
  }
  std::sort(errors.begin(), errors.end());
  return errors;
}

TEST(CrossingNormals, FollowTheSurface) {
  SceneSensor sensor;
  sensor.noise_mm = 1e-6;
  const auto views = scan_cusps(60, sensor, 1).views;
  const auto normals = crossing_normals(views, {}, Workers(2));
  ASSERT_TRUE(normals.has_value());
  const auto errors = angle_errors(views, *normals);
  ASSERT_FALSE(errors.empty());
  // Within a cell of 0.34 mm, the normals of flanks change by about 5 degrees, at the edges of
  // cusps by 40.
  EXPECT_LT(errors[errors.size() / 2], 6.0 * kDegree);
  EXPECT_LT(errors[errors.size() * 95 / 100], 32.0 * kDegree);
}

TEST(CrossingNormals, NoiseChangesNormalsByAFewDegrees) {
  const auto views = scan_cusps(60, SceneSensor{}, 2).views;
  const auto normals = crossing_normals(views, {}, Workers(2));
  ASSERT_TRUE(normals.has_value());
  const auto errors = angle_errors(views, *normals);
  EXPECT_LT(errors[errors.size() / 2], 8.0 * kDegree);
}

TEST(CrossingNormals, OnlyOnePatternGivesTheNormalWithinTheSheet) {
  const auto views = scan_cusps(1, SceneSensor{}, 3).views;
  const auto normals = crossing_normals(views, {}, Workers(1));
  ASSERT_TRUE(normals.has_value());
  const auto& profiles = views[0].view->profiles;
  for (std::size_t k = 0; k < profiles.size(); ++k) {
    for (const Vec3f& n : (*normals)[0][k]) {
      EXPECT_NEAR(n.norm(), 1.0F, 1e-5F);
      EXPECT_NEAR(n.cast<double>().dot(profiles[k].sheet_normal), 0.0, 1e-5);
      EXPECT_LT(n.z(), 0.0F);
    }
  }
}

TEST(CrossingNormals, OneThreadAndManyGiveTheSameBits) {
  const auto views = scan_cusps(8, SceneSensor{}, 4).views;
  const auto one = crossing_normals(views, {}, Workers(1));
  const auto many = crossing_normals(views, {}, Workers(4));
  EXPECT_EQ(*one, *many);
}

TEST(SurfaceSamples, AreAllPointsInTheWorldFrame) {
  const auto views = scan_cusps(4, SceneSensor{}, 5).views;
  const auto normals = crossing_normals(views, {}, Workers(1));
  const auto samples = surface_samples(views, *normals, Workers(2));
  std::size_t expected = 0;
  for (const AlignedView& view : views) expected += view.view->point_count();
  ASSERT_EQ(samples.size(), expected);
  const AlignedView& last = views.back();
  const Vec3 p = last.T_world_sensor * last.view->profiles.back().points.back().position_mm;
  EXPECT_TRUE(samples.back().position_mm.isApprox(p.cast<float>()));
  EXPECT_EQ(samples.back().view, ViewIndex(3));
}

}  // namespace
}  // namespace flytri::normals
