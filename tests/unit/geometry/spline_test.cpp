#include "core/geometry/spline.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"
#include "core/geometry/smoothing.h"

namespace flytri {
namespace {

TEST(CubicCurve, PassesThroughItsKnotsAndIsExactOnStraightLines) {
  const std::vector<double> parameters = {0, 1, 2.5, 3, 7};
  std::vector<Vec3> points;
  for (const double t : parameters) points.push_back(Vec3(1, -2, 0.5) * t + Vec3(3, 4, 5));
  const CubicCurve curve(parameters, points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    // Knots are stored in single precision: at 5 mm the resolution is 5e-7 mm.
    EXPECT_LT((curve.at(static_cast<double>(i)).position_mm - points[i]).norm(), 2e-6);
  }
  EXPECT_LT((curve.at(2.5).position_mm - (Vec3(1, -2, 0.5) * 2.75 + Vec3(3, 4, 5))).norm(), 2e-6);
}

TEST(CubicCurve, ConvergesOnACircleWithTheFourthPowerOfTheSpacing) {
  const auto worst_error = [](int knots) {
    std::vector<double> parameters;
    std::vector<Vec3> points;
    for (int i = 0; i < knots; ++i) {
      parameters.push_back(3.0 * i / (knots - 1));
      points.emplace_back(std::cos(parameters.back()), std::sin(parameters.back()), 0);
    }
    const CubicCurve curve(parameters, points);
    double worst = 0;  // without the ends, where the natural spline is only of second order
    for (double x = 0.3 * knots; x < 0.7 * knots; x += 0.07) {
      worst = std::max(worst, std::abs(curve.at(x).position_mm.norm() - 1.0));
    }
    return worst;
  };
  EXPECT_LT(worst_error(24), worst_error(12) / 8.0);
}

std::vector<ProfilePoint> noisy_arc(double radius_mm, double noise_mm, Random& random) {
  std::vector<ProfilePoint> points;
  for (int i = 0; i < 400; ++i) {
    const double x = 0.02 * (i - 200);
    const double z = radius_mm - std::sqrt(std::max(0.0, radius_mm * radius_mm - x * x));
    points.push_back({Vec3(x, 0, z + noise_mm * random.normal()),
                      Vec3f(0, 0, static_cast<float>(noise_mm)), static_cast<float>(i)});
  }
  return points;
}

TEST(Smoothing, RemovesNoiseAndKeepsEndsAndCurvature) {
  Random random(3);
  double error = 0.0, bias = 0.0, first = 0.0, last = 0.0;
  int count = 0;
  constexpr int kRuns = 40;
  for (int run = 0; run < kRuns; ++run) {
    const auto points = noisy_arc(5.0, 0.03, random);
    const auto smooth = smooth_profile(points, smoothing_sigma(points, {}));
    for (const SmoothedPoint& p : smooth) {
      const double x = p.position_mm.x();
      const double off = p.position_mm.z() - (5.0 - std::sqrt(25.0 - x * x));
      error += off * off;
      bias += off;
      ++count;
    }
    first += smooth.front().position_mm.z() - (5.0 - std::sqrt(25.0 - 16.0));
    last += smooth.back().position_mm.x() - points.back().position_mm.x();
  }
  EXPECT_LT(std::sqrt(error / count), 0.4 * 0.03);
  EXPECT_LT(std::abs(bias / count), 0.001);
  // The uncertainty of the end is about 0.6 sigma; that of the mean of 40 runs a sixth of it.
  EXPECT_LT(std::abs(first / kRuns), 0.012);
  EXPECT_LT(std::abs(last / kRuns), 0.005);
}

TEST(Smoothing, DoesNotChangeIdealPoints) {
  std::vector<ProfilePoint> points;
  for (int i = 0; i < 50; ++i) {
    points.push_back({Vec3(0.02 * i, 0, 0.001 * i), Vec3f(0, 0, 0.03F), static_cast<float>(i)});
  }
  EXPECT_LT(smoothing_sigma(points, {}), 0.01);
}

}  // namespace
}  // namespace flytri
