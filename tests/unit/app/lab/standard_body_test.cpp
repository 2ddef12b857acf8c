#include "app/lab/standard_body.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/geometry/sphere_mesh.h"

namespace flytri::lab {
namespace {

using ::testing::HasSubstr;

/// Spheres and plate without a jaw.
StandardBody bare_body() {
  return make_standard_body({}, sample_jaw::make_dentition(JawKind::kUpper, 1));
}

/// Points all over the plate, with noise along its normal.
TriangleMesh scanned_plate(const StandardBody& body, double noise_mm) {
  TriangleMesh scanned;
  Random random(3);
  for (int i = 0; i < 5000; ++i) {
    const Vec2 share(random.uniform() - 0.5, random.uniform() - 0.5);
    const Vec2 p = share.cwiseProduct(body.plate_mm);
    SurfacePoint point;
    point.position_mm =
        (body.T_jaw_plate * Vec3(p.x(), p.y(), noise_mm * random.normal())).cast<float>();
    scanned.vertices.push_back(point);
  }
  return scanned;
}

TEST(StandardBody, ASphereIsFoundWhereItIsAndAsLargeAsItIs) {
  const StandardBody body = bare_body();
  const Vec3 shift_mm(0.02, -0.01, 0.03);
  const TriangleMesh scanned =
      sphere_mesh(body.spheres_mm[2] + shift_mm, body.radius_mm + 0.015, 60);
  const auto fit = fit_sphere(scanned, body, 2);
  ASSERT_TRUE(fit);
  EXPECT_LT((fit->center_mm - body.spheres_mm[2] - shift_mm).norm(), 1e-5);
  EXPECT_NEAR(fit->radius_mm, body.radius_mm + 0.015, 1e-5);
  EXPECT_LT(fit->rms_mm, 1e-5);
}

TEST(StandardBody, ASphereThatWasNotScannedIsNamed) {
  const StandardBody body = bare_body();
  const auto fit = fit_sphere(sphere_mesh(body.spheres_mm[0], body.radius_mm, 60), body, 1);
  ASSERT_FALSE(fit);
  EXPECT_EQ(fit.error().code, ErrorCode::kInsufficient);
  EXPECT_THAT(fit.error().message, HasSubstr("sphere 2: only 0 points"));
}

TEST(StandardBody, ThePlateShowsTheNoiseAlongItsNormal) {
  const StandardBody body = bare_body();
  const auto noise_mm = plate_noise_mm(scanned_plate(body, 0.01), body);
  ASSERT_TRUE(noise_mm);
  EXPECT_NEAR(*noise_mm, 0.01, 0.0005);
  EXPECT_FALSE(plate_noise_mm({}, body));
}

TEST(StandardBody, ItsOwnSurfaceHasNoError) {
  const StandardBody body = bare_body();
  for (std::size_t i = 0; i < body.spheres_mm.size(); ++i) {
    const auto fit = fit_sphere(body.surface, body, i);
    ASSERT_TRUE(fit);
    EXPECT_NEAR(fit->radius_mm, body.radius_mm, 1e-5);
  }
}

}  // namespace
}  // namespace flytri::lab
