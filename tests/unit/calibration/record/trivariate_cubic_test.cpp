#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"
#include "core/calibration/record/calibration.h"

namespace flytri::calibration {
namespace {

TrivariateCubic random_cubic(Random& random) {
  TrivariateCubic cubic;
  cubic.center = Vec3(1.0, -2.0, 0.5);
  cubic.half_range = Vec3(10.0, 7.5, 8.0);
  for (double& c : cubic.coefficients) c = random.normal();
  return cubic;
}

TEST(TrivariateCubic, IsTheSumOfItsTerms) {
  Random random(1);
  const TrivariateCubic cubic = random_cubic(random);
  const Vec3 p(3.0, 4.0, -5.0);
  const Vec3 t = (p - cubic.center).cwiseQuotient(cubic.half_range);
  double sum = 0.0;
  for (int term = 0; term < TrivariateCubic::kTerms; ++term) {
    const auto& e = TrivariateCubic::kExponents[term];
    sum += cubic.coefficients[term] * std::pow(t.x(), e[0]) * std::pow(t.y(), e[1]) *
           std::pow(t.z(), e[2]);
  }
  EXPECT_NEAR(cubic(p), sum, 1e-12);
}

TEST(TrivariateCubic, GradientEqualsCentralDifferences) {
  constexpr double kStep_mm = 1e-3;
  Random random(2);
  for (int i = 0; i < 20; ++i) {
    const TrivariateCubic cubic = random_cubic(random);
    const Vec3 p(10.0 * random.normal(), 10.0 * random.normal(), 10.0 * random.normal());
    const Vec3 gradient = cubic.gradient(p);
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3 step = kStep_mm * Vec3::Unit(axis);
      // The error is the third derivative, at most 6 c / half_range^3, times step^2 / 6.
      EXPECT_NEAR(gradient[axis], (cubic(p + step) - cubic(p - step)) / (2 * kStep_mm), 1e-7);
    }
  }
}

}  // namespace
}  // namespace flytri::calibration
