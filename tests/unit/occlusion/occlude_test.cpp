#include "core/occlusion/occlude.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/occlusion/clearance.h"
#include "tests/support/cheek.h"

namespace flytri::occlusion {
namespace {

using testing::bite_relation;
using testing::Cheek;
using testing::coarse_jaw;

class Occlude : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    upper_ = new TriangleMesh(coarse_jaw(JawKind::kUpper, 3));
    lower_ = new TriangleMesh(coarse_jaw(JawKind::kLower, 3));
  }
  static void TearDownTestSuite() {
    delete upper_;
    delete lower_;
  }
  static Result<Occlusion> occlude(std::vector<BiteScan> bites,
                                   const OccludeOptions& options = {}) {
    return find_occlusion(*upper_, *lower_, bites, options, Workers(2), {});
  }
  static Cheek cheek(bool is_right, std::uint64_t seed,
                     const Isometry& T_upper_lower = bite_relation()) {
    return {*upper_, *lower_, T_upper_lower, is_right, seed};
  }
  /// Displacement of a point of the lower jaw by the error of the relation.
  static double error_mm(const Occlusion& found, const Vec3& p_mm) {
    return (found.T_upper_lower * bite_relation().inverse() * p_mm - p_mm).norm();
  }
  static void expect_refused(const Result<Occlusion>& found, ErrorCode code,
                             const std::string& words) {
    ASSERT_FALSE(found.has_value());
    EXPECT_EQ(found.error().code, code);
    EXPECT_NE(found.error().message.find(words), std::string::npos) << found.error().message;
  }

  static TriangleMesh *upper_, *lower_;
};
TriangleMesh* Occlude::upper_ = nullptr;
TriangleMesh* Occlude::lower_ = nullptr;

TEST_F(Occlude, FindsTheRelationFromOneCheek) {
  const Cheek right = cheek(true, 1);
  const auto found = occlude({{"bite", right.points()}});
  ASSERT_TRUE(found.has_value()) << found.error().message;
  // Noise of 10 µm over thousands of points.
  EXPECT_LT(error_mm(*found, found->middle_mm), 0.005);
  EXPECT_LT(rotation_angle(found->T_upper_lower * bite_relation().inverse()), 0.001);
  EXPECT_GT(found->bites[0].upper_share, 0.3);
  EXPECT_GT(found->bites[0].lower_share, 0.3);
}

TEST_F(Occlude, TheFarSideIsLessCertainThanTheScannedOne) {
  const Cheek right = cheek(true, 2), left = cheek(false, 3);
  const auto one = occlude({{"right", right.points()}});
  const auto both = occlude({{"right", right.points()}, {"left", left.points()}});
  ASSERT_TRUE(one && both);
  const Vec3 far_mm(-28.0, -20.0, 9.0);
  EXPECT_GT(one->uncertainty_mm(far_mm), 3.0 * one->uncertainty_mm(one->middle_mm));
  EXPECT_LT(both->uncertainty_mm(far_mm), 0.5 * one->uncertainty_mm(far_mm));
  EXPECT_LT(error_mm(*one, far_mm), 3.0 * one->uncertainty_mm(far_mm));
  EXPECT_LT(error_mm(*both, far_mm), 3.0 * both->uncertainty_mm(far_mm));
}

TEST_F(Occlude, ACheekInFrontOfTheTeethDoesNoHarm) {
  Cheek right = cheek(true, 4);
  right.add_tissue(right.points().size());
  const auto found = occlude({{"bite", right.points()}});
  ASSERT_TRUE(found.has_value()) << found.error().message;
  EXPECT_LT(error_mm(*found, found->middle_mm), 0.005);
}

TEST_F(Occlude, FindsABiteThatShowsLittleOfTheUpperJaw) {
  const Cheek right = cheek(true, 7);
  std::vector<SurfacePoint> points = right.upper_part();
  const auto lower_begin = right.points().begin() + static_cast<std::ptrdiff_t>(points.size());
  std::sort(points.begin(), points.end(), [](const SurfacePoint& a, const SurfacePoint& b) {
    return a.position_mm.x() < b.position_mm.x();
  });
  points.resize(points.size() / 4);
  points.insert(points.end(), lower_begin, right.points().end());
  const auto found = occlude({{"bite", points}});
  ASSERT_TRUE(found.has_value()) << found.error().message;
  EXPECT_LT(found->bites[0].upper_share, 0.2);
  EXPECT_LT(error_mm(*found, found->middle_mm), 3.0 * found->uncertainty_mm(found->middle_mm));
}

/// All sample jaws have teeth of much the same size: another patient's are larger.
TriangleMesh enlarged(TriangleMesh mesh) {
  for (SurfacePoint& vertex : mesh.vertices) vertex.position_mm *= 1.06F;
  return mesh;
}

TEST_F(Occlude, ABiteOfAnotherPatientIsRefused) {
  const TriangleMesh upper = enlarged(coarse_jaw(JawKind::kUpper, 11)),
                     lower = enlarged(coarse_jaw(JawKind::kLower, 11));
  const Cheek other(upper, lower, bite_relation(), true, 5);
  expect_refused(occlude({{"bite", other.points()}}), ErrorCode::kInconsistent, "does not fit the");
}

TEST_F(Occlude, ABiteThatShowsOneJawOnlyIsRefused) {
  const std::vector<SurfacePoint> part = cheek(true, 6).upper_part();
  expect_refused(occlude({{"bite", part}}), ErrorCode::kInconsistent, "does not fit the lower jaw");
}

TEST_F(Occlude, TwoBitesThatContradictEachOtherAreRefused) {
  const Isometry moved = Eigen::Translation3d(0.0, 0.8, 0.3) * bite_relation();
  const Cheek right = cheek(true, 7), left = cheek(false, 8, moved);
  expect_refused(occlude({{"right", right.points()}, {"left", left.points()}}),
                 ErrorCode::kInconsistent, "right and left contradict each other");
}

TEST_F(Occlude, MissingScansAreNamed) {
  expect_refused(occlude({}), ErrorCode::kInsufficient, "no bite scan");
  expect_refused(occlude({{"bite", {}}}), ErrorCode::kInsufficient, "bite: has no points");
  const Cheek right = cheek(true, 9);
  const std::vector<BiteScan> bites = {{"bite", right.points()}};
  expect_refused(find_occlusion(*upper_, {}, bites, {}, Workers(1), {}), ErrorCode::kInsufficient,
                 "the lower jaw");
  OccludeOptions options;
  options.min_share = 0.0;
  expect_refused(occlude(bites, options), ErrorCode::kBadOption, "min_share");
}

/// A square of 10 mm at a height, facing up or down.
TriangleMesh square(double z_mm, bool faces_up) {
  TriangleMesh mesh;
  constexpr std::uint32_t kSide = 21;
  for (std::uint32_t i = 0; i < kSide * kSide; ++i) {
    SurfacePoint point;
    point.position_mm = {0.5F * static_cast<float>(i % kSide), 0.5F * static_cast<float>(i / kSide),
                         static_cast<float>(z_mm)};
    point.normal = {0.0F, 0.0F, faces_up ? 1.0F : -1.0F};
    mesh.vertices.push_back(point);
  }
  for (std::uint32_t y = 0; y + 1 < kSide; ++y) {
    for (std::uint32_t x = 0; x + 1 < kSide; ++x) {
      const std::uint32_t a = y * kSide + x, b = a + 1, c = a + kSide, d = c + 1;
      if (faces_up) {
        mesh.triangles.insert(mesh.triangles.end(), {{a, b, c}, {b, d, c}});
      } else {
        mesh.triangles.insert(mesh.triangles.end(), {{a, c, b}, {b, c, d}});
      }
    }
  }
  return mesh;
}

TEST(Clearance, IsTheDistanceToTheOtherJawAndNegativeInsideIt) {
  const TriangleMesh floor = square(0.0, true);
  const JawSurface surface(floor);
  for (const double height_mm : {0.4, 0.01, -0.2}) {
    const TriangleMesh ceiling = square(height_mm, false);
    const Clearance found = find_clearance(ceiling, surface, Isometry::Identity(), 1.0, Workers(1));
    const Contact contact = contact_of(ceiling, found, 0.05);
    // The rim is not known: beyond it the floor ends.
    EXPECT_TRUE(std::isnan(found.front()));
    EXPECT_NEAR(found[10 * 21 + 10], height_mm, 1e-5);
    EXPECT_NEAR(contact.area_mm2, height_mm < 0.05 ? 100.0 : 0.0, 25.0);
    EXPECT_NEAR(contact.penetration_area_mm2, height_mm < -0.05 ? 100.0 : 0.0, 25.0);
    EXPECT_NEAR(contact.deepest_mm, std::max(0.0, -height_mm), 1e-5);
  }
}

}  // namespace
}  // namespace flytri::occlusion
