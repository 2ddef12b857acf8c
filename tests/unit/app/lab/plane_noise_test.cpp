#include "app/lab/plane_noise.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hw/simulated/optics/view_noise.h"
#include "tests/support/analytic_calibration.h"
#include "tests/support/line_image.h"
#include "tests/support/temporary_folder.h"

namespace flytri::lab {
namespace {

using testing::AnalyticSensor;
using ::testing::HasSubstr;

constexpr double kNear_mm = -3.0, kFar_mm = 3.0;
constexpr double kNearSigma_mm = 0.02, kFarSigma_mm = 0.06;
constexpr double kCorrelationSamples = 1.5;

/// The image of a plane that is bent by 0.1 mm along the lines and whose depth has noise,
/// correlated along each line.
cv::Mat bent_plane(Pattern pattern, double z_mm, double sigma_mm) {
  const AnalyticSensor sensor;
  const auto p = static_cast<std::size_t>(pattern);
  const bool vertical = pattern == Pattern::kVertical;
  testing::LineImage image;
  image.along_count = vertical ? sensor.size.height_px : sensor.size.width_px;
  image.across_count = vertical ? sensor.size.width_px : sensor.size.height_px;
  image.depth = CV_16U;
  image.full_scale = 65535.0;
  std::vector<testing::TrueLine> lines;
  for (int n = 0; n < sensor.line_counts[p]; ++n) {
    View normals;
    normals.profiles.push_back(
        {LineIndex(n), Vec3::UnitX(),
         std::vector<ProfilePoint>(static_cast<std::size_t>(image.along_count))});
    normals = simulated::add_noise(normals, {sigma_mm, kCorrelationSamples},
                                   static_cast<std::uint64_t>(n));
    std::vector<double> across_px;
    for (int along = 0; along < image.along_count; ++along) {
      const double bend_mm = 0.1 * std::pow(2.0 * along / image.along_count - 1.0, 2);
      const double off_mm = normals.profiles[0].points[std::size_t(along)].position_mm.z();
      across_px.push_back(sensor.across_px(pattern, n, along, z_mm + bend_mm + off_mm));
    }
    lines.push_back({[across_px](double along) { return across_px[std::size_t(along)]; },
                     sensor.line_sigma_px(z_mm), [](double) { return 30000.0; }});
  }
  return testing::draw(image, lines, pattern);
}

calibration::CalibrationSet bent_planes() {
  calibration::CalibrationSet set;
  for (const auto& [z_mm, sigma_mm] :
       {std::pair(kNear_mm, kNearSigma_mm), std::pair(kFar_mm, kFarSigma_mm)}) {
    calibration::CalibrationPlane plane;
    plane.z_mm = z_mm;
    plane.vertical = bent_plane(Pattern::kVertical, z_mm, sigma_mm);
    plane.horizontal = bent_plane(Pattern::kHorizontal, z_mm, sigma_mm);
    calibration::name_images(plane, set.planes.size());
    set.planes.push_back(plane);
  }
  return set;
}

TEST(PlaneNoise, HasTheSigmaAndTheCorrelationOfEachPlane) {
  const auto noise = plane_noise(bent_planes(), testing::analytic_calibration(), 1, Workers(2), {});
  ASSERT_TRUE(noise) << noise.error().message;
  for (const auto& [z_mm, sigma_mm] :
       {std::pair(kNear_mm, kNearSigma_mm), std::pair(kFar_mm, kFarSigma_mm)}) {
    const NoiseFigures figures = noise_figures(*noise, z_mm);
    // Ten lines of 300 samples, of which one in five is independent: sigma is known to 3 %. The
    // trend takes 4 % of slow noise, and with it some of the correlation.
    EXPECT_NEAR(figures.sigma_mm, sigma_mm, 0.1 * sigma_mm);
    EXPECT_NEAR(figures.correlation_samples, kCorrelationSamples, 0.2);
    EXPECT_NEAR(figures.kurtosis, 3.0, 0.5);
    EXPECT_LT(figures.beyond_3_sigma, 0.01);
  }
}

TEST(PlaneNoise, OfOneExposureIsLargerThanThatOfTheirMean) {
  const auto set = bent_planes();
  const auto one = plane_noise(set, testing::analytic_calibration(), 1, Workers(1), {});
  const auto nine = plane_noise(set, testing::analytic_calibration(), 9, Workers(2), {});
  ASSERT_TRUE(one && nine);
  const NoiseFigures of_one = noise_figures(*one, 0.0), of_nine = noise_figures(*nine, 0.0);
  EXPECT_NEAR(of_nine.sigma_mm, 3.0 * of_one.sigma_mm, 1e-6);
  EXPECT_NEAR(of_nine.stated_mm, 3.0 * of_one.stated_mm, 1e-6);
}

TEST(PlaneNoise, DoesNotDependOnTheNumberOfThreads) {
  const auto set = bent_planes();
  const auto one = plane_noise(set, testing::analytic_calibration(), 1, Workers(1), {});
  const auto two = plane_noise(set, testing::analytic_calibration(), 1, Workers(2), {});
  ASSERT_TRUE(one && two);
  for (const Pattern pattern : kPatterns) {
    const auto& series = one->series_near(pattern, kFar_mm);
    const auto& again = two->series_near(pattern, kFar_mm);
    ASSERT_EQ(series.size(), again.size());
    for (std::size_t k = 0; k < series.size(); ++k) {
      ASSERT_EQ(series[k].size(), again[k].size());
      for (std::size_t i = 0; i < series[k].size(); ++i) {
        EXPECT_EQ(series[k][i].off_mm, again[k][i].off_mm);
      }
    }
  }
}

TEST(PlaneNoise, PlanesWithoutLinesAreRefused) {
  auto set = bent_planes();
  for (auto& plane : set.planes) plane.horizontal.setTo(0);
  const auto noise = plane_noise(set, testing::analytic_calibration(), 1, Workers(1), {});
  ASSERT_FALSE(noise);
  EXPECT_EQ(noise.error().code, ErrorCode::kInsufficient);
  EXPECT_THAT(noise.error().message, HasSubstr("horizontal"));
}

TEST(PlaneNoise, AFolderWithoutASetIsNamedWithTheRemedy) {
  const TemporaryFolder folder;
  const auto noise = read_plane_noise(folder.path(), 1, Workers(1), {});
  ASSERT_FALSE(noise);
  EXPECT_THAT(noise.error().message, HasSubstr((folder / "calibration-set.json").string()));
  EXPECT_THAT(noise.error().message, HasSubstr("correct the path"));
}

}  // namespace
}  // namespace flytri::lab
