#include <gtest/gtest.h>

#include <filesystem>

#include "core/calibration/fit/calibrate.h"
#include "core/io/calibrations/calibration_set_file.h"
#include "core/io/recordings/recording.h"
#include "core/measurement/measure_view.h"
#include "tests/support/places.h"

namespace flytri::calibration {
namespace {

const std::filesystem::path kSet = testing::shared_data() / "calibration-intraoral";

TEST(RealCalibrationSet, ResidualsAreAtTheLimitOfThePolynomials) {
  if (!std::filesystem::exists(kSet)) GTEST_SKIP() << "needs " << kSet;
  const auto set = io::read_calibration_set(kSet);
  ASSERT_TRUE(set.has_value()) << set.error().message;
  const auto calibration = calibrate(*set, {}, Workers(2), {});
  ASSERT_TRUE(calibration.has_value()) << calibration.error().message;
  // Single samples scatter by their localization noise, 4 µm; the fit to 13,000 samples per line is
  // far more accurate. Noise-free fits of this sensor reach 0.5 µm laterally and 0.15 px in the
  // texture.
  for (const Pattern pattern : kPatterns) {
    EXPECT_LT(calibration->of(pattern).depth_residual_mm.rms, 6e-3);
    EXPECT_LT(calibration->of(pattern).width_residual_px.rms, 0.1);
  }
  EXPECT_LT(calibration->x_mm.residual.rms, 0.7e-3);
  EXPECT_LT(calibration->y_mm.residual.rms, 0.7e-3);
  EXPECT_LT(calibration->texture_u_px.residual.rms, 0.2);
  EXPECT_LT(calibration->texture_v_px.residual.rms, 0.2);
  ASSERT_TRUE(calibration->flash.has_value());
  EXPECT_LT(calibration->flash->residual.rms, 2e-3);
  EXPECT_EQ(calibration->of(Pattern::kVertical).line_count(), 10);
  EXPECT_EQ(calibration->of(Pattern::kHorizontal).line_count(), 7);
}

/// Compares the depth of each line, averaged over 64 rows of a plane, with the plane's z. The fit
/// does not use this plane, so this is the error of the calibration without the noise of single
/// samples.
TEST(RealCalibrationSet, APlaneNotUsedInTheFitIsMeasuredToTwoMicrometers) {
  if (!std::filesystem::exists(kSet)) GTEST_SKIP() << "needs " << kSet;
  auto set = io::read_calibration_set(kSet);
  ASSERT_TRUE(set.has_value());
  const CalibrationPlane left_out = set->planes[5];
  set->planes.erase(set->planes.begin() + 5);
  const auto calibration = calibrate(*set, {}, Workers(2), {});
  ASSERT_TRUE(calibration.has_value());
  double square = 0;
  int count = 0;
  for (const Pattern pattern : kPatterns) {
    const bool vertical = pattern == Pattern::kVertical;
    const Frame frame{FrameIndex(0), vertical ? FrameKind::kVertical : FrameKind::kHorizontal, 0.0,
                      vertical ? left_out.vertical : left_out.horizontal};
    const auto measured = measurement::measure_view(frame, *calibration, {});
    ASSERT_TRUE(measured.has_value());
    for (const Profile& profile : measured->view.profiles) {
      constexpr std::size_t kBlock = 64;
      for (std::size_t begin = 0; begin + kBlock <= profile.points.size(); begin += kBlock) {
        double mean = 0;
        for (std::size_t i = 0; i < kBlock; ++i) {
          mean += profile.points[begin + i].position_mm.z() / kBlock;
        }
        square += std::pow(mean - left_out.z_mm, 2);
        ++count;
      }
    }
  }
  const double rms_mm = std::sqrt(square / count);
  RecordProperty("rms_um", std::to_string(1e3 * rms_mm));
  EXPECT_GT(count, 150);
  EXPECT_LT(rms_mm, 2e-3);
}

}  // namespace
}  // namespace flytri::calibration
