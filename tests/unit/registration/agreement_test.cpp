#include "core/registration/agreement.h"

#include <gtest/gtest.h>

#include <cmath>

namespace flytri::registration {
namespace {

constexpr double kRadiusMm = 10.0;
constexpr double kSideMm = 1.6;  // default side of a place

/// A crossing in the center of place (i, j) of a source at the origin of the world.
Crossing crossing_at(int i, int j, double sigmas) {
  Crossing c;
  c.p_mm = Vec3((i + 0.5) * kSideMm, (j + 0.5) * kSideMm, 0.3 * i);
  c.sigma_mm = 0.01;
  c.distance_mm = sigmas * c.sigma_mm;
  return c;
}

TEST(Agreement, IsTheDocumentedRatioOfLikelihoods) {
  std::vector<Crossing> crossings;
  for (int i = 0; i < 30; ++i) crossings.push_back(crossing_at(i, 0, i < 27 ? 1.0 : -30.0));
  const Agreement agreement = judge(crossings, Isometry::Identity(), kRadiusMm);
  EXPECT_EQ(agreement.places, 30);
  EXPECT_EQ(agreement.agreeing, 27);
  EXPECT_NEAR(agreement.proof, 21 * std::log(1.9), 1e-12);
  EXPECT_NEAR(agreement.contradiction, 3 * std::log(10.0), 1e-12);
  EXPECT_NEAR(agreement.evidence, 21 * std::log(1.9) + 3 * std::log(0.1), 1e-12);
}

TEST(Agreement, CountsPlacesNotCrossings) {
  std::vector<Crossing> crossings;
  for (int i = 0; i < 5; ++i) {
    for (int copy = 0; copy < 100; ++copy) crossings.push_back(crossing_at(i, 2, 0.5));
  }
  const Agreement agreement = judge(crossings, Isometry::Identity(), kRadiusMm);
  EXPECT_EQ(agreement.places, 5);
  // Six places always agree, because the fit has six unknowns: they prove nothing.
  EXPECT_EQ(agreement.evidence, 0.0);
}

TEST(Agreement, PlacesAreFixedInTheSourceFrame) {
  const Isometry T_world_source = exp_twist((Twist() << 0.3, -0.8, 1.1, 30, -50, 8).finished());
  std::vector<Crossing> crossings;
  for (int i = 0; i < 20; ++i) {
    crossings.push_back(crossing_at(i % 5, i / 5, 1.0));
    crossings.back().p_mm = T_world_source * crossings.back().p_mm;
  }
  EXPECT_EQ(judge(crossings, T_world_source, kRadiusMm).places, 20);
}

TEST(Agreement, NearCrossingsAlwaysAgree) {
  std::vector<Crossing> crossings;
  for (int i = 0; i < 20; ++i) {
    crossings.push_back(crossing_at(i, 0, 1.0));
    crossings.back().sigma_mm = 1e-5;
    crossings.back().distance_mm = i < 10 ? 0.0009 * kRadiusMm : 0.0011 * kRadiusMm;
  }
  EXPECT_EQ(judge(crossings, Isometry::Identity(), kRadiusMm).agreeing, 10);
}

TEST(Agreement, NamesOptionsOutOfRange) {
  AgreementOptions options;
  options.max_sigmas = 1.0;
  EXPECT_FALSE(options.validate());
  options = {};
  options.place_share = std::nan("");
  EXPECT_FALSE(options.validate());
}

}  // namespace
}  // namespace flytri::registration
