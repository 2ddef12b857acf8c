#include "core/refinement/length_uncertainty.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/refinement/refine.h"
#include "tests/support/wavy_scene.h"

namespace flytri::refinement {
namespace {

using testing::SceneSensor;

/// Smooth enough for a quadric in a cell of half a millimeter: all errors are from noise.
double height(double x, double y) { return 0.8 * std::sin(0.8 * x) + 0.8 * std::sin(0.9 * y); }

/// A path over the surface along x: a view each half millimeter.
std::vector<AlignedView> scan_strip(double begin_mm, double end_mm, const SceneSensor& sensor,
                                    std::uint64_t seed) {
  Random random(seed);
  std::vector<AlignedView> views;
  for (double x = begin_mm; x <= end_mm; x += 0.5) {
    const auto i = static_cast<int>(views.size());
    Twist twist;
    twist << 0.1 * std::sin(0.3 * x), 0.1 * std::sin(0.4 * x), 0.2 * std::sin(0.2 * x), x,
        2.0 * std::sin(0.5 * x), 0.0;
    const Isometry T_world_sensor = exp_twist(twist);
    View view =
        measure_scene(height, sensor, i % 2 == 0 ? Pattern::kVertical : Pattern::kHorizontal,
                      T_world_sensor, random);
    view.frame = FrameIndex(i);
    view.time_s = i / 30.0;
    views.push_back({std::make_shared<View>(std::move(view)), T_world_sensor});
  }
  return views;
}

constexpr double kLength_mm = 30.0;

Span whole_strip() {
  return {Vec3(0.0, 0.0, height(0.0, 0.0)), Vec3(kLength_mm, 0.0, height(kLength_mm, 0.0))};
}

std::optional<double> uncertainty_of(const std::vector<AlignedView>& views, const Span& span,
                                     int threads = 2) {
  const auto sigmas = length_uncertainties(views, std::vector{span}, {}, Workers(threads));
  EXPECT_TRUE(sigmas.has_value());
  return sigmas->front();
}

/// How the views near a place have moved it.
Vec3 moved_mm(const std::vector<AlignedView>& views, const std::vector<AlignedView>& truth,
              const Vec3& p_mm) {
  Vec3 sum = Vec3::Zero();
  double count = 0.0;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const Isometry& T_true = truth[i].T_world_sensor;
    if (std::abs(T_true.translation().x() - p_mm.x()) > 2.0) continue;
    sum += views[i].T_world_sensor * (T_true.inverse() * p_mm) - p_mm;
    count += 1.0;
  }
  return sum / count;
}

/// Errors of the length over several scans, by what is predicted, RMS.
double error_by_prediction(const SceneSensor& sensor) {
  constexpr std::uint64_t kScans = 10;
  const Span span = whole_strip();
  const Vec3 along = (span.to_mm - span.from_mm).normalized();
  double errors2 = 0.0, predicted2 = 0.0;
  for (std::uint64_t seed = 1; seed <= kScans; ++seed) {
    const auto truth = scan_strip(0.0, kLength_mm, sensor, seed);
    auto views = truth;
    EXPECT_TRUE(refine_jointly(views, {}, Workers(2)).has_value());
    const double error_mm =
        (moved_mm(views, truth, span.to_mm) - moved_mm(views, truth, span.from_mm)).dot(along);
    const double sigma_mm = uncertainty_of(views, span).value_or(0.0);
    errors2 += error_mm * error_mm;
    predicted2 += sigma_mm * sigma_mm;
  }
  return std::sqrt(errors2 / predicted2);
}

// The spread of ten values scatters by a quarter: these are two and a half of that.
TEST(LengthUncertainty, PredictsTheErrorsOfWhiteNoise) {
  const double ratio = error_by_prediction(SceneSensor{});
  EXPECT_GT(ratio, 0.5);
  EXPECT_LT(ratio, 1.6) << "ratio";
}

TEST(LengthUncertainty, PredictsTheErrorsOfNoiseThatNeighborsShare) {
  SceneSensor sensor;
  sensor.correlation_samples = 8.0;
  const double ratio = error_by_prediction(sensor);
  EXPECT_GT(ratio, 0.5);
  EXPECT_LT(ratio, 1.6) << "ratio";
}

TEST(LengthUncertainty, GrowsWithTheNoiseAndWithTheLength) {
  SceneSensor quiet;
  quiet.noise_mm *= 0.5;
  const auto views = scan_strip(0.0, kLength_mm, SceneSensor{}, 1);
  const double whole_mm = uncertainty_of(views, whole_strip()).value();
  const auto quiet_views = scan_strip(0.0, kLength_mm, quiet, 1);
  EXPECT_LT(uncertainty_of(quiet_views, whole_strip()).value(), 0.8 * whole_mm);
  Span half = whole_strip();
  half.to_mm = Vec3(0.5 * kLength_mm, 0.0, height(0.5 * kLength_mm, 0.0));
  EXPECT_LT(uncertainty_of(views, half).value(), 0.8 * whole_mm);
}

TEST(LengthUncertainty, ThereIsNoneWhereNobodyLooked) {
  const auto views = scan_strip(0.0, kLength_mm, {}, 1);
  EXPECT_EQ(uncertainty_of(views, {whole_strip().from_mm, Vec3(90.0, 0.0, 0.0)}), std::nullopt);
}

TEST(LengthUncertainty, ThereIsNoneBetweenPartsThatNothingConnects) {
  auto views = scan_strip(0.0, 5.0, {}, 1);
  const auto far = scan_strip(60.0, 65.0, {}, 2);
  views.insert(views.end(), far.begin(), far.end());
  const auto at = [](double x) { return Vec3(x, 0.0, height(x, 0.0)); };
  EXPECT_EQ(uncertainty_of(views, {at(2.0), at(62.0)}), std::nullopt);
  EXPECT_NE(uncertainty_of(views, {at(0.0), at(5.0)}), std::nullopt);
}

TEST(LengthUncertainty, OneThreadAndManyGiveTheSameBits) {
  const auto views = scan_strip(0.0, 10.0, {}, 1);
  const Span span = {whole_strip().from_mm, Vec3(10.0, 0.0, height(10.0, 0.0))};
  EXPECT_EQ(uncertainty_of(views, span, 1), uncertainty_of(views, span, 4));
}

TEST(LengthUncertainty, RefusesOptionsOutOfRange) {
  const auto views = scan_strip(0.0, 2.0, {}, 1);
  LengthUncertaintyOptions options;
  options.cluster_mm = 0.0;
  const auto sigmas = length_uncertainties(views, std::vector{whole_strip()}, options, Workers(1));
  ASSERT_FALSE(sigmas.has_value());
  EXPECT_EQ(sigmas.error().code, ErrorCode::kBadOption);
}

}  // namespace
}  // namespace flytri::refinement
