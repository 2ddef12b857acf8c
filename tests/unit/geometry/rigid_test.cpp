#include "core/geometry/rigid.h"

#include <gtest/gtest.h>

#include "core/base/random.h"

namespace flytri {
namespace {

Twist random_twist(Random& random, double scale) {
  Twist twist;
  for (int i = 0; i < 6; ++i) twist[i] = scale * random.normal();
  return twist;
}

TEST(Rigid, LogInvertsExpForSmallAndLargeTwists) {
  Random random(1);
  for (const double scale : {1e-9, 1e-4, 0.5}) {
    for (int i = 0; i < 100; ++i) {
      const Twist twist = random_twist(random, scale);
      EXPECT_LT((log_twist(exp_twist(twist)) - twist).norm(), 1e-12 + 1e-9 * scale);
    }
  }
}

TEST(Rigid, InterpolationEqualsBothPosesAtItsEnds) {
  Random random(2);
  const Isometry T_a_b = exp_twist(random_twist(random, 0.5));
  const Isometry T_a_c = exp_twist(random_twist(random, 0.5));
  EXPECT_TRUE(interpolate(T_a_b, T_a_c, 0.0).isApprox(T_a_b, 1e-12));
  EXPECT_TRUE(interpolate(T_a_b, T_a_c, 1.0).isApprox(T_a_c, 1e-12));
}

}  // namespace
}  // namespace flytri
