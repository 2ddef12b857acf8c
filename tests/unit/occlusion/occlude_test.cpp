#include "core/occlusion/occlude.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "assets/sample_jaw/sample_jaw.h"
#include "core/base/random.h"
#include "core/occlusion/clearance.h"

namespace flytri::occlusion {
namespace {

TriangleMesh make_jaw(JawKind kind, std::uint64_t seed) {
  sample_jaw::SampleJawOptions options;
  options.kind = kind;
  options.seed = seed;
  options.tooth_cell_mm = 0.3;
  options.gum_cell_mm = 0.5;
  return sample_jaw::make_sample_jaw(options, Workers()).value();
}

/// Half a turn about y: z points to the opposing teeth in both frames. The jaws do not touch.
Isometry bite_relation() {
  return Isometry(Eigen::Translation3d(0.4, -0.3, 19.0) *
                  exp_twist((Twist() << 0.01, -0.02, 0.015, 0, 0, 0).finished()) *
                  Eigen::AngleAxisd(std::numbers::pi, Vec3::UnitY()));
}

/// What a sensor sees of both closed jaws from one cheek, with noise, in a frame of its own.
class Cheek {
 public:
  Cheek(const TriangleMesh& upper, const TriangleMesh& lower, const Isometry& T_upper_lower,
        bool is_right, std::uint64_t seed)
      : random_(seed), is_right_(is_right) {
    add(upper, Isometry::Identity());
    upper_count_ = points_.size();
    add(lower, T_upper_lower);
  }
  [[nodiscard]] const std::vector<SurfacePoint>& points() const { return points_; }
  /// The part that lies on the upper jaw.
  [[nodiscard]] std::vector<SurfacePoint> upper_part() const {
    return {points_.begin(), points_.begin() + static_cast<std::ptrdiff_t>(upper_count_)};
  }
  /// Adds a cheek: a wavy surface in front of the teeth.
  void add_tissue(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      const double y_mm = random_.uniform(-25.0, 10.0), z_mm = random_.uniform(0.0, 20.0);
      const double x_mm =
          (is_right_ ? 1.0 : -1.0) * (36.0 + std::sin(0.4 * y_mm) + std::cos(0.5 * z_mm));
      SurfacePoint point;
      point.position_mm = (T_bite_upper_ * Vec3(x_mm, y_mm, z_mm)).cast<float>();
      point.normal = (T_bite_upper_.linear() * Vec3(is_right_ ? 1.0 : -1.0, 0, 0)).cast<float>();
      points_.push_back(point);
    }
  }

 private:
  void add(const TriangleMesh& jaw, const Isometry& T_upper_jaw) {
    const double side = is_right_ ? 1.0 : -1.0;
    for (const SurfacePoint& vertex : jaw.vertices) {
      const Vec3 p_mm = T_upper_jaw * vertex.position_mm.cast<double>();
      const Vec3 normal = T_upper_jaw.linear() * vertex.normal.cast<double>();
      if (side * normal.x() < 0.3 || side * p_mm.x() < 14.0 || p_mm.y() > 14.0) continue;
      if (p_mm.z() < 2.0 || p_mm.z() > 17.0) continue;
      SurfacePoint point = vertex;
      point.position_mm =
          (T_bite_upper_ * Vec3(p_mm + 0.01 * random_.normal() * normal)).cast<float>();
      point.normal = (T_bite_upper_.linear() * normal).cast<float>();
      points_.push_back(point);
    }
  }

  Random random_;
  bool is_right_;
  // The sensor looks along z, from the cheek inwards.
  Isometry T_bite_upper_ =
      Isometry(Eigen::Translation3d(3.0, -2.0, 30.0) *
               Eigen::AngleAxisd(0.4, Vec3(1.0, 0.5, -0.3).normalized()) *
               Eigen::AngleAxisd((is_right_ ? 0.5 : -0.5) * std::numbers::pi, Vec3::UnitY()));
  std::vector<SurfacePoint> points_;
  std::size_t upper_count_ = 0;
};

class Occlude : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    upper_ = new TriangleMesh(make_jaw(JawKind::kUpper, 3));
    lower_ = new TriangleMesh(make_jaw(JawKind::kLower, 3));
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

/// All sample jaws have teeth of much the same size: another patient's are larger.
TriangleMesh enlarged(TriangleMesh mesh) {
  for (SurfacePoint& vertex : mesh.vertices) vertex.position_mm *= 1.06F;
  return mesh;
}

TEST_F(Occlude, ABiteOfAnotherPatientIsRefused) {
  const TriangleMesh upper = enlarged(make_jaw(JawKind::kUpper, 11)),
                     lower = enlarged(make_jaw(JawKind::kLower, 11));
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
    const Clearance found =
        find_clearance(ceiling, surface, Isometry::Identity(), 0.05, 1.0, Workers(1));
    // The rim is not known: beyond it the floor ends.
    EXPECT_TRUE(std::isnan(found.distances_mm.front()));
    EXPECT_NEAR(found.distances_mm[10 * 21 + 10], height_mm, 1e-5);
    EXPECT_NEAR(found.contact_area_mm2, height_mm < 0.05 ? 100.0 : 0.0, 25.0);
    EXPECT_NEAR(found.penetration_area_mm2, height_mm < -0.05 ? 100.0 : 0.0, 25.0);
    EXPECT_NEAR(found.deepest_mm, std::max(0.0, -height_mm), 1e-5);
  }
}

}  // namespace
}  // namespace flytri::occlusion
