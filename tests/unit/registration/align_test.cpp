#include "core/registration/align.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/wavy_scene.h"

namespace flytri::registration {
namespace {

using testing::SceneSensor;

Twist small_motion(Random& random, double rotation_rad, double translation_mm) {
  Twist twist;
  for (int i = 0; i < 3; ++i) twist[i] = rotation_rad * random.normal();
  for (int i = 3; i < 6; ++i) twist[i] = translation_mm * random.normal();
  return twist;
}

/// RMS displacement of the view's points between two poses.
double displacement_mm(const PreparedView& view, const Isometry& T_a_b, const Isometry& T_c_b) {
  return unknowns_of(T_a_b.inverse() * T_c_b, {view.center_mm, view.radius_mm}).norm();
}

struct Pair {
  PreparedView target, source;
  Isometry T_target_source;
};

Pair make_pair(std::uint64_t seed, double noise_mm,
               const testing::HeightField& height = testing::cusped_height) {
  Random random(seed);
  SceneSensor sensor;
  sensor.noise_mm = noise_mm;
  const Isometry T_world_target = exp_twist(small_motion(random, 0.2, 3.0));
  const Isometry T_target_source = exp_twist(small_motion(random, 0.015, 0.25));
  const auto view = [&](Pattern pattern, const Isometry& T_world_sensor) {
    return prepare_view(testing::measure_scene(height, sensor, pattern, T_world_sensor, random));
  };
  return {view(Pattern::kVertical, T_world_target),
          view(Pattern::kHorizontal, T_world_target * T_target_source), T_target_source};
}

TEST(Align, RecoversKnownMotionInBothDirections) {
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    const Pair pair = make_pair(seed, 0.03);
    const Alignment there = align_view(pair.source, pair.target, Isometry::Identity()).value();
    const Alignment back = align_view(pair.target, pair.source, Isometry::Identity()).value();
    EXPECT_EQ(there.outcome, AlignOutcome::kAligned);
    EXPECT_EQ(back.outcome, AlignOutcome::kAligned);
    // 70 crossings of two lines, each smoothed to about 10 µm; the worst direction is a few times
    // less certain than the best.
    EXPECT_LT(displacement_mm(pair.source, there.T_target_source, pair.T_target_source), 0.03);
    EXPECT_LT(displacement_mm(pair.target, back.T_target_source, pair.T_target_source.inverse()),
              0.03);
  }
}

TEST(Align, IdealDataIsLimitedOnlyByItsSampling) {
  const Pair pair = make_pair(3, 0.0);
  const Alignment ideal = align_view(pair.source, pair.target, Isometry::Identity()).value();
  ASSERT_TRUE(ideal.aligned());
  // Error of splines through points 0.04 mm apart, on cusps of 0.1 mm radius.
  EXPECT_LT(displacement_mm(pair.source, ideal.T_target_source, pair.T_target_source), 0.003);
}

TEST(Align, ThePapersWeightsAndResidualFindTheSameMotion) {
  const Pair pair = make_pair(4, 0.03);
  AlignOptions options;
  options.weight = CrossingWeight::kDepthVariation;
  const Alignment by_depth =
      align_view(pair.source, pair.target, Isometry::Identity(), options).value();
  EXPECT_LT(displacement_mm(pair.source, by_depth.T_target_source, pair.T_target_source), 0.03);

  // Point-to-point converges slowly along the surface: more iterations and a less accurate result.
  options.residual = ResidualKind::kPointToPoint;
  options.max_iterations = 200;
  const Alignment to_point =
      align_view(pair.source, pair.target, Isometry::Identity(), options).value();
  EXPECT_LT(displacement_mm(pair.source, to_point.T_target_source, pair.T_target_source),
            0.5 * displacement_mm(pair.source, Isometry::Identity(), pair.T_target_source));
}

TEST(Align, ReportsSurfacesThatCanSlideAlongThemselves) {
  const testing::HeightField plane = [](double x, double y) { return 0.1 * x - 0.05 * y; };
  const testing::HeightField ridge = [](double x, double) { return 1.5 * std::sin(x); };
  for (const auto& height : {plane, ridge}) {
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
      const Pair pair = make_pair(seed, 0.03, height);
      const Alignment alignment =
          align_view(pair.source, pair.target, Isometry::Identity()).value();
      EXPECT_EQ(alignment.outcome, AlignOutcome::kUndetermined) << alignment.uncertainty_mm;
      // Undetermined directions keep the prediction.
      EXPECT_LT(alignment.moved_mm, 1.5);
    }
  }
}

TEST(Align, ViewsOfDifferentPlacesDoNotAlign) {
  int aligned = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const Pair here = make_pair(seed, 0.03);
    const testing::HeightField other = [](double x, double y) {
      return testing::cusped_height(y + 31.0, 17.0 - x);
    };
    const Pair there = make_pair(seed, 0.03, other);
    aligned +=
        align_view(there.source, here.target, Isometry::Identity()).value().aligned() ? 1 : 0;
  }
  EXPECT_EQ(aligned, 0);
}

TEST(Align, RejectsBadOptions) {
  AlignOptions options;
  options.start_distance_share = -1.0;
  const Pair pair = make_pair(1, 0.03);
  const auto result = align_view(pair.source, pair.target, Isometry::Identity(), options);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kBadOption);
}

}  // namespace
}  // namespace flytri::registration
