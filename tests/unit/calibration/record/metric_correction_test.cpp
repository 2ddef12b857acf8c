#include "core/calibration/record/metric_correction.h"

#include <gtest/gtest.h>

#include "tests/support/analytic_calibration.h"

namespace flytri::calibration {
namespace {

const MetricCorrection kCorrection{1.01, 0.98, {0.02, -0.03}};

TEST(MetricCorrection, MovesEveryMeasuredPoint) {
  const Calibration& before = testing::analytic_calibration();
  const Calibration after = corrected(before, kCorrection);
  for (const Pattern pattern : kPatterns) {
    const auto& lines = before.of(pattern).lines;
    for (std::size_t n = 0; n < lines.size(); n += 7) {
      for (std::size_t along = 0; along < lines[n].size(); along += 50) {
        const LineRow& row = lines[n][along];
        if (!row.valid()) continue;
        const LinePixel pixel{double(along), 0.5 * (row.area_min_px + row.area_max_px)};
        const Vec3 expected =
            kCorrection.matrix() * before.locate(pattern, LineIndex(int(n)), pixel);
        EXPECT_LT((after.locate(pattern, LineIndex(int(n)), pixel) - expected).norm(), 1e-9);
      }
    }
  }
}

TEST(MetricCorrection, KeepsWhatTheTextureCameraSees) {
  const Calibration& before = testing::analytic_calibration();
  const Calibration after = corrected(before, kCorrection);
  for (const double x : {-3.0, 0.5, 4.0}) {
    for (const double z : {-3.0, 0.0, 2.0}) {
      const Vec3 point(x, 0.7 * x - 1.0, z);
      const Pixel expected = before.project_to_texture(point);
      const Pixel found = after.project_to_texture(kCorrection.matrix() * point);
      EXPECT_NEAR(found.u_px, expected.u_px, 1e-6);
      EXPECT_NEAR(found.v_px, expected.v_px, 1e-6);
    }
  }
}

TEST(MetricCorrection, OfNothingChangesNothing) {
  const Calibration& before = testing::analytic_calibration();
  const Calibration after = corrected(before, {});
  const Vec3 point(1.0, -2.0, 0.5);
  EXPECT_NEAR((before.x_mm(point) - after.x_mm(point)), 0.0, 1e-12);
  EXPECT_NEAR(before.project_to_texture(point).u_px, after.project_to_texture(point).u_px, 1e-9);
}

}  // namespace
}  // namespace flytri::calibration
