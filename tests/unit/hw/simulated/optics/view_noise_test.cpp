#include "hw/simulated/optics/view_noise.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace flytri::simulated {
namespace {

// One long profile with `count` points at z = 0.
View straight_view(int count) {
  View view;
  view.profiles.push_back({LineIndex(0), Vec3::UnitX(), std::vector<ProfilePoint>(count)});
  for (int i = 0; i < count; ++i) view.profiles[0].points[i].position_mm = {0.0, 0.02 * i, 0.0};
  return view;
}

TEST(ViewNoise, HasTheRequestedDeviationAndCorrelation) {
  const int count = 100000;
  const double length = 1.5;
  const View ideal = straight_view(count);
  const View noisy =
      add_noise(ideal, {.sigma_mm = 0.03, .correlation_samples = length, .seed = 7}, 3);
  std::array<double, 5> products{};
  for (int i = 0; i + 4 < count; ++i)
    for (int lag = 0; lag < 5; ++lag)
      products[lag] += noisy.profiles[0].points[i].position_mm.z() *
                       noisy.profiles[0].points[i + lag].position_mm.z() / count;
  // 100,000 samples with about 20,000 independent ones determine sigma to 0.5 %; five times that is
  // allowed.
  EXPECT_NEAR(std::sqrt(products[0]), 0.03, 0.03 * 0.025);
  // Autocorrelation of white noise smoothed by a Gaussian with standard deviation L: exp(-lag^2 /
  // (4 L^2)).
  for (int lag = 1; lag < 5; ++lag)
    EXPECT_NEAR(products[lag] / products[0], std::exp(-lag * lag / (4.0 * length * length)), 0.03);
}

TEST(ViewNoise, MovesPointsOnlyAlongZAndDependsOnTheStream) {
  const View ideal = straight_view(50);
  const ViewNoise noise{.sigma_mm = 0.03, .seed = 7};
  const View a = add_noise(ideal, noise, 1);
  const View again = add_noise(ideal, noise, 1);
  const View b = add_noise(ideal, noise, 2);
  for (int i = 0; i < 50; ++i) {
    const ProfilePoint& point = a.profiles[0].points[i];
    EXPECT_EQ(point.position_mm.head<2>(), ideal.profiles[0].points[i].position_mm.head<2>());
    EXPECT_EQ(point.position_mm, again.profiles[0].points[i].position_mm);
    EXPECT_NE(point.position_mm.z(), b.profiles[0].points[i].position_mm.z());
    EXPECT_EQ(point.deviation_mm, Vec3f(0.0F, 0.0F, 0.03F));
  }
}

}  // namespace
}  // namespace flytri::simulated
