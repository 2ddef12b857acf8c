#include "core/registration/align.h"

#include <gtest/gtest.h>

#include "tests/support/wavy_scene.h"

namespace flytri {
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

Pair make_pair(std::uint64_t seed, double noise_mm) {
  Random random(seed);
  SceneSensor sensor;
  sensor.noise_mm = noise_mm;
  const Isometry T_world_target = exp_twist(small_motion(random, 0.2, 3.0));
  const Isometry T_target_source = exp_twist(small_motion(random, 0.015, 0.25));
  const auto view = [&](Pattern pattern, const Isometry& T_world_sensor) {
    return prepare_view(
        testing::measure_scene(testing::cusped_height, sensor, pattern, T_world_sensor, random));
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
    // 70 crossings of two lines smoothed to about 10 µm each; the worst direction is a few times
    // weaker than the best.
    EXPECT_LT(displacement_mm(pair.source, there.T_target_source, pair.T_target_source), 0.03);
    EXPECT_LT(displacement_mm(pair.target, back.T_target_source, pair.T_target_source.inverse()),
              0.03);
  }
}

}  // namespace
}  // namespace flytri
