#include "core/reduction/reduce.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "core/base/random.h"
#include "core/reduction/merge.h"

namespace flytri::reduction {
namespace {

constexpr double kSpacing = 0.02;  // of samples along a line, mm
constexpr double kSigma = 0.02;    // of a sample along z, mm

/// Views of the height field z(x, y) on 0..1 mm. Each view has lines along y, 0.25 mm apart.
std::vector<SurfaceSample> scan(const std::function<double(double, double)>& height, int view_count,
                                double sigma) {
  Random random(3);
  std::vector<SurfaceSample> samples;
  for (int view = 0; view < view_count; ++view) {
    const double shift = 0.25 * random.uniform();
    for (double x = shift; x < 1.0; x += 0.25) {
      for (double y = 0.0; y < 1.0; y += kSpacing) {
        const Vec3 p(x, y, height(x, y) + sigma * random.normal());
        samples.push_back({p.cast<float>(), -Vec3f::UnitZ(), Vec3f(0, 0, static_cast<float>(sigma)),
                           ViewIndex(view)});
      }
    }
  }
  return samples;
}

double flat(double /*x*/, double /*y*/) { return 0.0; }

bool same_bits(const PointCloud& a, const PointCloud& b) {
  return std::equal(
      a.begin(), a.end(), b.begin(), b.end(), [](const SurfacePoint& p, const SurfacePoint& q) {
        return p.position_mm == q.position_mm && p.normal == q.normal && p.sigma_mm == q.sigma_mm;
      });
}

TEST(Reduce, AnyOrderOfSamplesAndAnyThreadsGiveTheSameBits) {
  std::vector<SurfaceSample> samples = scan(flat, 40, kSigma);
  const auto first = reduce_samples(samples, {}, Workers(1));
  std::reverse(samples.begin(), samples.end());
  const auto second = reduce_samples(samples, {}, Workers(4));
  ASSERT_TRUE(first && second);
  EXPECT_GT(first->points.size(), 100U);
  EXPECT_LT(first->points.size(), samples.size() / 2);
  EXPECT_TRUE(same_bits(first->points, second->points));
}

TEST(Reduce, StatedUncertaintyMatchesTheScatter) {
  const auto reduced =
      reduce_samples(scan(flat, 80, kSigma), {.noise_length_samples = 0.01}, Workers());
  ASSERT_TRUE(reduced);
  double chi2 = 0.0;
  for (const SurfacePoint& p : reduced->points) {
    const double ratio = p.position_mm.z() / p.sigma_mm;
    chi2 += ratio * ratio;
  }
  // Below 1: the uncertainty is increased where a few views differ by chance.
  EXPECT_GT(std::sqrt(chi2 / reduced->points.size()), 0.6);
  EXPECT_LT(std::sqrt(chi2 / reduced->points.size()), 1.1);
}

TEST(Reduce, RemovesOutliersThatOtherViewsContradict) {
  std::vector<SurfaceSample> samples = scan(flat, 60, kSigma);
  Random random(5);
  for (int i = 0; i < 50; ++i) {
    const Vec3 p(random.uniform(0.1, 0.9), random.uniform(0.1, 0.9), 0.2);
    samples.push_back({p.cast<float>(), -Vec3f::UnitZ(), Vec3f(0, 0, static_cast<float>(kSigma)),
                       ViewIndex(100 + i)});
  }
  const auto reduced = reduce_samples(samples, {}, Workers());
  ASSERT_TRUE(reduced);
  EXPECT_GE(reduced->counts.outlier_count + reduced->counts.isolated_count, 50U);
  for (const SurfacePoint& p : reduced->points) {
    EXPECT_LT(std::abs(p.position_mm.z()), 5 * kSigma);
  }
}

TEST(Reduce, SeparatesTheTwoSidesOfAThinPlate) {
  std::vector<SurfaceSample> samples = scan(flat, 40, 0.005);
  const std::size_t front = samples.size();
  for (std::size_t i = 0; i < front; ++i) {
    SurfaceSample back = samples[i];
    back.position_mm.z() += 0.05F;  // the plate is thinner than the length of a cell
    back.normal = Vec3f::UnitZ();
    back.view = ViewIndex(back.view.value + 1000);  // each view sees only one side
    samples.push_back(back);
  }
  const auto reduced = reduce_samples(samples, {}, Workers());
  ASSERT_TRUE(reduced);
  for (const SurfacePoint& p : reduced->points) {
    EXPECT_NEAR(p.position_mm.z(), p.normal.z() > 0 ? 0.05 : 0.0, 0.02);
  }
}

TEST(Reduce, ResolvesTwoGroovesAtTheResolutionLimit) {
  // A line of six pixels is 0.12 mm wide. The grooves are two line widths apart in x.
  constexpr double kPitch = 0.24;
  const auto grooves = [](double x, double /*y*/) {
    if (std::abs(x - 0.5) > kPitch) return 0.0;
    return 0.025 * (1.0 - std::cos(2 * std::numbers::pi * (x - 0.5) / kPitch));
  };
  const auto reduced = reduce_samples(scan(grooves, 200, 0.01), {}, Workers());
  ASSERT_TRUE(reduced);
  const auto mean_height = [&](double x) {
    double sum = 0.0;
    int count = 0;
    for (const SurfacePoint& p : reduced->points) {
      if (std::abs(p.position_mm.x() - x) > 0.02) continue;
      sum += p.position_mm.z();
      ++count;
    }
    return sum / count;
  };
  // The ridge between the grooves keeps more than half of their depth of 0.05 mm.
  const double ridge = mean_height(0.5);
  EXPECT_GT(mean_height(0.5 - kPitch / 2) - ridge, 0.025);
  EXPECT_GT(mean_height(0.5 + kPitch / 2) - ridge, 0.025);
}

TEST(Reduce, RefusesPointsThatAreFarAway) {
  for (const float far_mm : {1e5F, 1e9F, 1e30F}) {
    std::vector<SurfaceSample> samples = scan(flat, 4, kSigma);
    samples[7].position_mm.y() = far_mm;
    samples[70].position_mm = Vec3f::Constant(-far_mm);
    const auto reduced = reduce_samples(samples, {}, Workers(2));
    ASSERT_FALSE(reduced) << far_mm;
    EXPECT_EQ(reduced.error().code, ErrorCode::kInconsistent);
    EXPECT_NE(reduced.error().message.find("calibrate"), std::string::npos);
  }
}

TEST(Reduce, RefusesPointsOfHugeUncertainty) {
  std::vector<SurfaceSample> samples = scan(flat, 4, kSigma);
  for (SurfaceSample& sample : samples) sample.deviation_mm.z() = 1e6F;
  const auto reduced = reduce_samples(samples, {.cell_mm = 0.06}, Workers(2));
  ASSERT_FALSE(reduced);
  EXPECT_EQ(reduced.error().code, ErrorCode::kInconsistent);
}

TEST(Reduce, NamesBadOptions) {
  const auto reduced = reduce_samples({}, {.outlier_sigmas = -1.0}, Workers(1));
  ASSERT_FALSE(reduced);
  EXPECT_NE(reduced.error().message.find("outlier_sigmas"), std::string::npos);
}

TEST(MeanVarianceShare, MatchesCorrelatedNoise) {
  EXPECT_DOUBLE_EQ(MeanVariance(1.5).share(1), 1.0);
  EXPECT_NEAR(MeanVariance(0.01).share(4), 0.25, 1e-12);  // white noise
  EXPECT_NEAR(MeanVariance(1e6).share(4), 1.0, 1e-9);     // fully correlated
}

}  // namespace
}  // namespace flytri::reduction
