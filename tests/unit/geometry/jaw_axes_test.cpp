#include "core/geometry/jaw_axes.h"

#include <gtest/gtest.h>

#include "tests/support/fake_arch.h"

namespace flytri {
namespace {

using testing::arch;
using testing::kTurned;

class JawAxesOf : public ::testing::TestWithParam<std::pair<double, double>> {};

TEST_P(JawAxesOf, FollowTheJawInAnyOrientation) {
  const auto [half_length_mm, bend] = GetParam();
  const JawAxes axes = jaw_axes(arch(half_length_mm, bend, kTurned));
  // The mean normal of the arch is occlusal but for the few steps of the sampling.
  EXPECT_GT(axes.occlusal.dot(kTurned.linear().col(2)), 0.99);
  EXPECT_GT(axes.buccal.dot(kTurned.linear().col(1)), 0.99);
  EXPECT_NEAR(axes.occlusal.dot(axes.buccal), 0.0, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Jaws, JawAxesOf,
                         ::testing::Values(std::pair(30.0, 0.8),    // a whole arch
                                           std::pair(15.0, 0.2)));  // a bent quadrant

TEST(JawAxes, TheBoxFollowsTheJawInAnyOrientation) {
  const auto volume_of = [](const Isometry& T_world_arch) {
    const std::vector<Vec3> corners = jaw_axes(arch(30.0, 0.8, T_world_arch)).corners_mm();
    EXPECT_EQ(corners.size(), 8U);
    return (corners[7] - corners[0]).norm();
  };
  EXPECT_NEAR(volume_of(kTurned), volume_of(Isometry::Identity()), 0.01);
}

TEST(JawAxes, NothingScannedHasNoBox) { EXPECT_TRUE(jaw_axes(SurfelModel{}).corners_mm().empty()); }

TEST(JawAxes, TellAnArchFromAQuadrant) {
  EXPECT_TRUE(jaw_axes(arch(30.0, 1.6, kTurned)).is_arch);
  EXPECT_FALSE(jaw_axes(arch(15.0, 0.4, kTurned)).is_arch);
}

/// A place on the arch at x, on its chewing surface or one of its flanks.
JawPlace place_at(double x_mm, const Vec3& normal_on_arch) {
  const JawAxes axes = jaw_axes(arch(30.0, 1.6, kTurned));
  const Vec3 place_mm(x_mm, -1.6 * x_mm * x_mm / 30.0, 0.0);
  return place_on_jaw(axes, kTurned * place_mm, kTurned.linear() * normal_on_arch);
}

TEST(PlaceOnJaw, DividesAnArchIntoPartsAndSides) {
  // The first axis is buccal x occlusal: y x z = x of the arch.
  const JawPlace front = place_at(3.0, Vec3::UnitY());
  EXPECT_EQ(front.part, JawPart::kFront);
  EXPECT_EQ(front.side, JawSide::kBuccal);
  EXPECT_EQ(place_at(3.0, -Vec3::UnitY()).side, JawSide::kLingual);
  const JawPlace molar = place_at(28.0, Vec3::UnitX());
  EXPECT_EQ(molar.part, JawPart::kMolars);
  EXPECT_TRUE(molar.is_on_positive_side);
  EXPECT_EQ(molar.side, JawSide::kBuccal);
  EXPECT_EQ(place_at(-28.0, Vec3::UnitX()).side, JawSide::kLingual);
  EXPECT_FALSE(place_at(-28.0, Vec3::UnitX()).is_on_positive_side);
  EXPECT_EQ(place_at(20.0, Vec3::UnitZ()).side, JawSide::kOcclusal);
  EXPECT_EQ(place_at(21.0, Vec3::UnitZ()).part, JawPart::kPremolars);
}

TEST(PlaceOnJaw, OfAQuadrantNamesTheSideAlone) {
  const JawAxes axes = jaw_axes(arch(15.0, 0.4, kTurned));
  const JawPlace place = place_on_jaw(axes, kTurned * Vec3(5.0, 0.0, 0.0), kTurned.linear().col(1));
  EXPECT_EQ(place.part, JawPart::kUnknown);
  EXPECT_EQ(place.side, JawSide::kBuccal);
}

}  // namespace
}  // namespace flytri
