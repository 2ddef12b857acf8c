#include "hw/simulated/optics/measured_noise.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/workers.h"
#include "hw/simulated/optics/view_noise.h"

namespace flytri::simulated {
namespace {

constexpr double kNear_mm = -4.0, kFar_mm = 4.0;

/// Correlated between neighbors by 0.5, as sums of two neighbors of white noise are.
NoiseSeries series_at(double z_mm, double sigma_mm, Pattern pattern, std::uint64_t seed) {
  NoiseSeries series{pattern, z_mm, {}};
  Random random(seed);
  double before = random.normal();
  for (int i = 0; i < 500; ++i) {
    const double now = random.normal();
    series.samples.push_back({static_cast<float>(sigma_mm * (before + now) / std::sqrt(2.0)),
                              static_cast<float>(1.1 * sigma_mm)});
    before = now;
  }
  return series;
}

/// 2 µm near, 8 µm far.
ViewNoise noise_of_two_depths() {
  std::vector<NoiseSeries> all;
  for (const Pattern pattern : kPatterns) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      all.push_back(series_at(kNear_mm, 0.002, pattern, seed));
      all.push_back(series_at(kFar_mm, 0.008, pattern, 100 + seed));
    }
  }
  return {.seed = 7,
          .measured = std::make_shared<const MeasuredNoise>(MeasuredNoise::create(all).value())};
}

/// A profile whose first half is near and whose second half is far.
View step_view(int count) {
  View view;
  view.profiles.push_back({LineIndex(0), Vec3::UnitX(), std::vector<ProfilePoint>(count)});
  for (int i = 0; i < count; ++i) {
    view.profiles[0].points[i].position_mm = {0.1, 0.02 * i, i < count / 2 ? -1.0 : 1.0};
  }
  return view;
}

TEST(MeasuredNoise, KeepsSigmaAndCorrelationOfEachDepth) {
  const int half = 20000;
  const View ideal = step_view(2 * half);
  const View noisy = add_noise(ideal, noise_of_two_depths(), 1);
  for (const bool far : {false, true}) {
    const double sigma_mm = far ? 0.008 : 0.002;
    double square = 0.0, product = 0.0, before = 0.0;
    for (int i = far ? half : 0; i < (far ? 2 * half : half); ++i) {
      const ProfilePoint& point = noisy.profiles[0].points[i];
      const Vec3 off_mm = point.position_mm - ideal.profiles[0].points[i].position_mm;
      EXPECT_EQ(off_mm.head<2>(), Vec2::Zero());
      EXPECT_EQ(point.deviation_mm, Vec3f(0.0F, 0.0F, static_cast<float>(1.1 * sigma_mm)));
      square += off_mm.z() * off_mm.z() / half;
      product += off_mm.z() * before / half;
      before = off_mm.z();
    }
    // The series have 10,000 samples, correlated: their sigma is known to 1 %.
    EXPECT_NEAR(std::sqrt(square), sigma_mm, 0.05 * sigma_mm);
    // Segments join every few hundred samples, without correlation.
    EXPECT_NEAR(product / square, 0.5, 0.04);
  }
}

TEST(MeasuredNoise, HasTheSameBitsForOneAndTwoThreads) {
  const ViewNoise noise = noise_of_two_depths();
  const View ideal = step_view(300);
  std::array<std::vector<View>, 2> scans;
  for (int threads = 1; threads <= 2; ++threads) {
    std::vector<View>& views = scans[static_cast<std::size_t>(threads - 1)];
    views.resize(16);
    Workers(threads).for_each(views.size(),
                              [&](std::size_t i) { views[i] = add_noise(ideal, noise, i); });
  }
  for (std::size_t v = 0; v < scans[0].size(); ++v) {
    for (std::size_t i = 0; i < 300; ++i) {
      EXPECT_EQ(scans[0][v].profiles[0].points[i].position_mm,
                scans[1][v].profiles[0].points[i].position_mm);
    }
  }
  EXPECT_NE(scans[0][0].profiles[0].points[0].position_mm,
            scans[0][1].profiles[0].points[0].position_mm);
}

TEST(MeasuredNoise, NeedsSeriesOfBothPatterns) {
  const auto noise = MeasuredNoise::create({series_at(0.0, 0.002, Pattern::kVertical, 1)});
  ASSERT_FALSE(noise);
  EXPECT_EQ(noise.error().code, ErrorCode::kInsufficient);
  EXPECT_THAT(noise.error().message, ::testing::HasSubstr("horizontal"));
}

}  // namespace
}  // namespace flytri::simulated
