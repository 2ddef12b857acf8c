#include "core/evaluation/surface_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "core/base/random.h"
#include "core/geometry/mesh_distance.h"
#include "tests/support/sample_meshes.h"

namespace flytri::evaluation {
namespace {

TriangleMesh plane() {
  return height_field({.half_width_mm = 5.0, .step_mm = 0.25}, [](double, double) { return 0.0; });
}

TEST(ClosestOnTriangle, NoPointOfAFineGridIsCloser) {
  Random random(5);
  const auto corner = [&] {
    return Vec3(random.normal(), random.normal(), random.normal()).cast<float>().eval();
  };
  for (int trial = 0; trial < 200; ++trial) {
    const Vec3f a = corner(), b = corner(), c = corner(), p = 2.0F * corner();
    const Vec3f point = closest_on_triangle(p, a, b, c);
    float best = 1e9F;
    constexpr int kGrid = 60;
    for (int i = 0; i <= kGrid; ++i)
      for (int j = 0; i + j <= kGrid; ++j) {
        const float u = static_cast<float>(i) / kGrid;
        const float v = static_cast<float>(j) / kGrid;
        best = std::min(best, (p - (a + u * (b - a) + v * (c - a))).norm());
      }
    const float found = (p - point).norm();
    EXPECT_LE(found, best + 1e-4F);
    // Some grid point is within a grid step of the closest point.
    EXPECT_GE(found, best - ((b - a).norm() + (c - a).norm()) / kGrid);
  }
}

TEST(MeshDistance, EqualsBruteForce) {
  const TriangleMesh mesh =
      height_field({.half_width_mm = 3.0, .step_mm = 0.3},
                   [](double x, double y) { return std::sin(2.0 * x) * std::cos(1.7 * y); });
  const MeshDistance tree(mesh);
  Random random(3);
  for (int trial = 0; trial < 300; ++trial) {
    const Vec3f p =
        Vec3(random.uniform(-5, 5), random.uniform(-5, 5), random.uniform(-4, 4)).cast<float>();
    double best = 1e9;
    for (const Triangle& t : mesh.triangles)
      best = std::min<double>(best, (closest_on_triangle(p, mesh.vertices[t[0]].position_mm,
                                                         mesh.vertices[t[1]].position_mm,
                                                         mesh.vertices[t[2]].position_mm) -
                                     p)
                                        .norm());
    EXPECT_NEAR(tree.closest(p).distance_mm, best, 1e-6);
    EXPECT_EQ(std::isfinite(tree.closest(p, 0.5).distance_mm), best <= 0.5);
    EXPECT_EQ(tree.is_within(p, 0.5), best <= 0.5);
  }
}

TEST(DistanceStatistics, MeetTheirDefinitions) {
  std::vector<double> distances;
  for (int i = 0; i <= 100; ++i) distances.push_back(100.0 - i);
  const DistanceStatistics statistics = distance_statistics(distances);
  EXPECT_EQ(statistics.count, 101);
  EXPECT_DOUBLE_EQ(statistics.mean_mm, 50.0);
  EXPECT_DOUBLE_EQ(statistics.median_mm, 50.0);
  EXPECT_DOUBLE_EQ(statistics.percentile_95_mm, 95.0);
  EXPECT_DOUBLE_EQ(statistics.max_mm, 100.0);
  // Sum of squares of 0..n is n (n + 1) (2 n + 1) / 6.
  EXPECT_DOUBLE_EQ(statistics.rms_mm, std::sqrt(100.0 * 201.0 / 6.0));
}

TEST(SurfaceError, MeasuresAnOffset) {
  Isometry T = Isometry::Identity();
  T.translation().z() = 0.03;
  const SurfaceError error =
      surface_error(transformed(plane(), T), plane(), {}, {}, Workers(1)).value();
  EXPECT_NEAR(error.distance.rms_mm, 0.03, 1e-6);
  EXPECT_NEAR(error.distance.max_mm, 0.03, 1e-6);
  EXPECT_EQ(error.completeness.near_surface, 1.0);
}

TEST(SurfaceError, CountsFarVertices) {
  TriangleMesh result = plane();
  for (std::size_t i = 0; i < result.vertices.size(); i += 2)
    result.vertices[i].position_mm.z() = 0.2F;
  const auto count = static_cast<double>(result.vertices.size());
  const SurfaceError error = surface_error(result, plane(), {}, {}, Workers(1)).value();
  EXPECT_DOUBLE_EQ(error.far_share, std::ceil(count / 2.0) / count);
}

TEST(SurfaceError, CompletenessIncludesTheSurfaceBetweenVertices) {
  // Two large triangles have only four vertices: the surface is complete, but has few vertices.
  const TriangleMesh coarse =
      height_field({.half_width_mm = 5.0, .step_mm = 10.0}, [](double, double) { return 0.0; });
  const SurfaceError error = surface_error(coarse, plane(), {}, {}, Workers(1)).value();
  EXPECT_EQ(error.completeness.near_surface, 1.0);
  EXPECT_LT(error.completeness.near_vertex, 0.01);
}

TEST(SurfaceError, OnlySelectedVerticesCount) {
  const TriangleMesh truth = plane();
  TriangleMesh left;
  left.vertices = truth.vertices;
  for (const Triangle& t : truth.triangles)
    if (truth.vertices[t[0]].position_mm.x() < 0.0F) left.triangles.push_back(t);
  std::vector<bool> asked(truth.vertices.size());
  for (std::size_t i = 0; i < asked.size(); ++i)
    asked[i] = truth.vertices[i].position_mm.x() < -0.01F;
  EXPECT_EQ(surface_error(left, truth, asked, {}, Workers(1))->completeness.near_surface, 1.0);
  EXPECT_NEAR(surface_error(left, truth, {}, {}, Workers(1))->completeness.near_surface, 0.51,
              0.03);
}

TEST(Completeness, CountsWhereLinesOfBothPatternsWere) {
  const auto line_at = [](Pattern pattern, double x_mm) {
    View view;
    view.pattern = pattern;
    Profile& profile = view.profiles.emplace_back();
    for (double y_mm = -1.0; y_mm <= 1.0; y_mm += 0.05)
      profile.points.push_back({Vec3(x_mm, y_mm, 0.0), Vec3f::Zero()});
    return AlignedView{std::make_shared<const View>(std::move(view))};
  };
  const std::vector<AlignedView> views = {line_at(Pattern::kVertical, 0.0),
                                          line_at(Pattern::kHorizontal, 0.5)};
  const TriangleMesh truth = plane();
  const std::vector<bool> crossed = crossed_vertices(truth, views, 0.3, Workers(2));
  std::int64_t count = 0;
  for (std::size_t i = 0; i < crossed.size(); ++i) {
    if (!crossed[i]) continue;
    ++count;
    EXPECT_EQ(truth.vertices[i].position_mm.x(), 0.25F) << "the only column near both lines";
  }
  EXPECT_EQ(count, 9);
  EXPECT_EQ(completeness(truth, truth, crossed, 0.1, Workers(1)).selected, count);
  EXPECT_EQ(completeness(truth, truth, crossed, 0.1, Workers(1)).near_vertex, 1.0);
}

TEST(SurfaceError, RejectsInputThatCannotBeCompared) {
  EXPECT_EQ(surface_error({}, plane(), {}, {}, Workers(1)).error().code, ErrorCode::kInsufficient);
  EXPECT_EQ(surface_error(plane(), plane(), {true}, {}, Workers(1)).error().code,
            ErrorCode::kInconsistent);
}

}  // namespace
}  // namespace flytri::evaluation
