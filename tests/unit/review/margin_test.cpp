#include "core/review/margin.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/random.h"
#include "core/geometry/sphere_mesh.h"
#include "core/review/closed_line.h"
#include "tests/support/revolved.h"

namespace flytri::review {
namespace {

using testing::FinishLine;
using ::testing::HasSubstr;
using testing::Preparation;

/// Distance from a point to a closed line.
double to_line_mm(const Vec3& p_mm, const std::vector<Vec3>& line_mm) {
  double least_mm = 1e9;
  for (std::size_t i = 0; i < line_mm.size(); ++i) {
    const Vec3 &a = line_mm[i], &b = line_mm[(i + 1) % line_mm.size()];
    const Vec3 step = b - a;
    const double share = std::clamp(step.dot(p_mm - a) / step.squaredNorm(), 0.0, 1.0);
    least_mm = std::min(least_mm, (a + share * step - p_mm).norm());
  }
  return least_mm;
}

struct LineError {
  double rms_um = 0.0, largest_um = 0.0;
};

LineError line_error(const std::vector<Vec3>& points_mm, const std::vector<Vec3>& line_mm) {
  LineError error;
  for (const Vec3& p_mm : points_mm) {
    const double off_um = 1e3 * to_line_mm(p_mm, line_mm);
    error.rms_um += off_um * off_um / static_cast<double>(points_mm.size());
    error.largest_um = std::max(error.largest_um, off_um);
  }
  error.rms_um = std::sqrt(error.rms_um);
  return error;
}

std::vector<Vec3> places_of(const Polyline& line) {
  std::vector<Vec3> places_mm;
  for (const MeasuredPoint& point : line.points) places_mm.push_back(point.position_mm);
  return places_mm;
}

/// Points near the margin, as a hand clicks them: up to 0.3 mm beside it.
std::vector<Vec3> clicks_near(const Preparation& tooth, int count, std::uint64_t seed) {
  Random random(seed);
  std::vector<Vec3> clicks_mm;
  for (int i = 0; i < count; ++i) {
    const auto at =
        tooth.margin_mm.size() * static_cast<std::size_t>(i) / static_cast<std::size_t>(count);
    const Vec3 off(random.normal(), random.normal(), random.normal());
    clicks_mm.push_back(tooth.margin_mm[at] + 0.3 * random.uniform() * off.normalized());
  }
  return clicks_mm;
}

/// Checks the line against the truth both ways, so that no part of the margin is left out.
void expect_margin(const Preparation& tooth, const Result<Margin>& margin, double rms_um,
                   double largest_um, const std::string& which) {
  ASSERT_TRUE(margin) << which << ": " << margin.error().message;
  const std::vector<Vec3> line_mm = places_of(margin->line);
  const LineError error = line_error(line_mm, tooth.margin_mm);
  const LineError missed = line_error(tooth.margin_mm, line_mm);
  fmt::print("{}: {:.1f} µm RMS, {:.1f} µm at most; the other way {:.1f}, {:.1f}\n", which,
             error.rms_um, error.largest_um, missed.rms_um, missed.largest_um);
  EXPECT_LT(error.rms_um, rms_um) << which;
  EXPECT_LT(error.largest_um, largest_um) << which;
  EXPECT_LT(missed.largest_um, largest_um) << which;
  EXPECT_TRUE(margin->line.is_closed);
}

TEST(Margin, FollowsTheEdgeOfAShoulder) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    testing::PreparationOptions options;
    options.seed = seed;
    const Preparation tooth = testing::preparation(options);
    const auto margin = find_margin(tooth.mesh, clicks_near(tooth, 5, seed), {}, Workers(2));
    expect_margin(tooth, margin, 25.0, 50.0, fmt::format("shoulder, noise {}", seed));
  }
}

TEST(Margin, FollowsTheEdgeOfAChamfer) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    testing::PreparationOptions options;
    options.finish_line = FinishLine::kChamfer;
    options.seed = seed;
    const Preparation tooth = testing::preparation(options);
    const auto margin = find_margin(tooth.mesh, clicks_near(tooth, 5, seed), {}, Workers(2));
    expect_margin(tooth, margin, 25.0, 50.0, fmt::format("chamfer, noise {}", seed));
  }
}

TEST(Margin, FollowsARounderEdgeAndLargerTriangles) {
  for (const double spacing_mm : {0.06, 0.15}) {
    testing::PreparationOptions options;
    options.edge_radius_mm = 0.1;
    options.spacing_mm = spacing_mm;
    const Preparation tooth = testing::preparation(options);
    const auto margin = find_margin(tooth.mesh, clicks_near(tooth, 4, 9), {}, Workers(2));
    expect_margin(tooth, margin, 40.0, 80.0, fmt::format("radius 0.1, triangles {}", spacing_mm));
  }
}

TEST(Margin, UncertaintyIsAboutTheError) {
  const Preparation tooth = testing::preparation({});
  MarginOptions options;
  options.smooth_mm = options.step_mm;  // the uncertainty is that before smoothing
  const auto margin = find_margin(tooth.mesh, clicks_near(tooth, 5, 4), options, Workers(2));
  ASSERT_TRUE(margin) << margin.error().message;
  double squares = 0.0, expected = 0.0;
  for (const MeasuredPoint& point : margin->line.points) {
    ASSERT_TRUE(std::isfinite(point.sigma_mm));
    squares += std::pow(to_line_mm(point.position_mm, tooth.margin_mm), 2);
    expected += std::pow(point.sigma_mm, 2);
  }
  fmt::print("error by uncertainty: {:.2f}\n", std::sqrt(squares / expected));
  EXPECT_GT(squares, 0.2 * expected);
  EXPECT_LT(squares, 4.0 * expected);
}

TEST(Margin, IsTheSameForAnyNumberOfThreads) {
  const Preparation tooth = testing::preparation({});
  const auto one = find_margin(tooth.mesh, clicks_near(tooth, 5, 4), {}, Workers(1));
  const auto three = find_margin(tooth.mesh, clicks_near(tooth, 5, 4), {}, Workers(3));
  ASSERT_TRUE(one && three);
  EXPECT_EQ(places_of(one->line), places_of(three->line));
}

TEST(Margin, NeedsAnEdgeNearEachClick) {
  const Preparation tooth = testing::preparation({});
  std::vector<Vec3> clicks_mm = clicks_near(tooth, 5, 4);
  EXPECT_EQ(find_margin(tooth.mesh, std::span(clicks_mm).first(2), {}, Workers(1)).error().code,
            ErrorCode::kBadOption);
  clicks_mm[2].z() -= 1.2;  // on the flank of the root
  const auto margin = find_margin(tooth.mesh, clicks_mm, {}, Workers(1));
  ASSERT_FALSE(margin);
  EXPECT_THAT(margin.error().message, HasSubstr("no edge within 0.5 mm of the point"));
}

TEST(Margin, OfASmoothSurfaceIsNone) {
  const TriangleMesh smooth = sphere_mesh(Vec3::Zero(), 4.0, 60);
  const std::vector<Vec3> clicks_mm = {{4, 0, 0}, {0, 4, 0}, {-4, 0, 0}};
  EXPECT_EQ(find_margin(smooth, clicks_mm, {}, Workers(1)).error().code, ErrorCode::kInsufficient);
}

TEST(Margin, ClicksOnOneSideAreRefused) {
  // The shortest way from the last click to the first leads back over the second.
  const Preparation tooth = testing::preparation({});
  const std::vector<Vec3>& m = tooth.margin_mm;
  const auto margin =
      find_margin(tooth.mesh, std::vector<Vec3>{m[0], m[100], m[200]}, {}, Workers(1));
  ASSERT_FALSE(margin);
  EXPECT_EQ(margin.error().code, ErrorCode::kInconsistent);
  EXPECT_THAT(margin.error().message, HasSubstr("comes back on itself"));
}

TEST(ClosedLine, SmoothingKeepsACircle) {
  std::vector<Vec3> circle;
  for (int i = 0; i < 250; ++i)
    circle.emplace_back(4.0 * std::cos(0.008 * std::numbers::pi * i),
                        4.0 * std::sin(0.008 * std::numbers::pi * i), 1.0);
  const std::vector<Vec3> even = evenly_spaced(circle, 0.2);
  EXPECT_EQ(even.size(), 126U);
  for (const Vec3& p : smoothed(even, std::vector<double>(even.size(), 1.0), 4, 0.05))
    EXPECT_NEAR(p.head<2>().norm(), 4.0, 1e-3);
  for (std::size_t i = 0; i < even.size(); ++i)
    EXPECT_NEAR(directions(even, 2)[i].dot(even[i]), 0.0, 0.02);
}

TEST(ClosedLine, SmoothingPassesOverAnOutlierAndAGap) {
  std::vector<Vec3> circle;
  for (int i = 0; i < 250; ++i)
    circle.emplace_back(4.0 * std::cos(0.008 * std::numbers::pi * i),
                        4.0 * std::sin(0.008 * std::numbers::pi * i), 1.0);
  std::vector<double> weights(circle.size(), 1.0);
  circle[40].z() += 0.5;
  circle[90].z() += 5.0;
  weights[90] = 0.0;
  const std::vector<Vec3> smooth = smoothed(circle, weights, 6, 0.05);
  for (const Vec3& p : smooth) EXPECT_NEAR(p.z(), 1.0, 0.02);
}

}  // namespace
}  // namespace flytri::review
