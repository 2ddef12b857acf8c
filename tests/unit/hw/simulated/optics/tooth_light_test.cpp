#include "hw/simulated/optics/tooth_light.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numeric>

#include "hw/simulated/optics/chip.h"
#include "hw/simulated/optics/image_simulator.h"

namespace flytri::simulated {
namespace {

double light_of(const SubsurfaceSpread& spread) {
  return std::accumulate(spread.shares().begin(), spread.shares().end(), 0.0);
}

double mean_mm(const SubsurfaceSpread& spread) {
  double sum = 0.0;
  for (std::size_t i = 0; i < spread.shares().size(); ++i)
    sum += spread.shares()[i] * spread.position_mm(i);
  return sum / light_of(spread);
}

/// Half of the light comes out within this distance of the line.
double half_reach_mm(const SubsurfaceSpread& spread) {
  const std::size_t middle = spread.shares().size() / 2;
  double sum = spread.shares()[middle];
  for (std::size_t i = 1; i <= middle; ++i) {
    sum += spread.shares()[middle - i] + spread.shares()[middle + i];
    if (sum >= 0.5 * light_of(spread)) return static_cast<double>(i) * spread.kCell_mm;
  }
  return spread.kReach_mm;
}

const Vec2 kUpright = Vec2::Zero();
const Vec2 kInclined(std::sin(0.5), 0.0);

TEST(SubsurfaceSpread, WhatIsNotAbsorbedComesOut) {
  for (const ScatteringMedium& medium : {enamel(), dentin()})
    for (const Vec2& incidence : {kUpright, kInclined}) {
      const SubsurfaceSpread spread(medium, incidence);
      EXPECT_NEAR(light_of(spread), spread.total(), 0.01 * spread.total());
    }
  ScatteringMedium medium = enamel();
  medium.absorption_per_mm = 0.0;
  EXPECT_NEAR(SubsurfaceSpread(medium, kInclined).total(), 1.0, 1e-9);
  medium.absorption_per_mm = 0.1;
  EXPECT_LT(SubsurfaceSpread(medium, kInclined).total(), 0.9);
}

TEST(SubsurfaceSpread, LightComesOutAsFarAsTheRefractedRayGoesInAFreePath) {
  ScatteringMedium medium = dentin();
  medium.scattering_per_mm = 20.0;
  medium.absorption_per_mm = 0.2;
  const double path_mm = 1.0 / (medium.scattering_per_mm + medium.absorption_per_mm);
  const double aside_mm = path_mm * kInclined.x() / medium.refractive_index;
  // Deeper sources lose more light, which takes some percent of the shift.
  EXPECT_NEAR(mean_mm(SubsurfaceSpread(medium, kInclined)), aside_mm, 0.15 * aside_mm);
  EXPECT_NEAR(mean_mm(SubsurfaceSpread(medium, -kInclined)), -aside_mm, 0.15 * aside_mm);
  EXPECT_NEAR(mean_mm(SubsurfaceSpread(medium, kUpright)), 0.0, 1e-9);
  EXPECT_NEAR(mean_mm(SubsurfaceSpread(medium, {0.0, 0.5})), 0.0, 1e-9);
}

TEST(SubsurfaceSpread, AShorterFreePathShiftsAndBroadensLess) {
  ScatteringMedium dense = enamel();
  dense.scattering_per_mm *= 4.0;
  const SubsurfaceSpread wide(enamel(), kInclined), narrow(dense, kInclined);
  EXPECT_LT(mean_mm(narrow), 0.5 * mean_mm(wide));
  EXPECT_LT(half_reach_mm(narrow), 0.5 * half_reach_mm(wide));
}

TriangleMesh white_plane(double z_mm) {
  TriangleMesh plane;
  for (const float y : {-60.0F, 60.0F})
    for (const float x : {-60.0F, 60.0F}) {
      SurfacePoint corner;
      corner.position_mm = {x, y, static_cast<float>(z_mm)};
      corner.normal = -Vec3f::UnitZ();
      corner.color = {255, 255, 255};
      plane.vertices.push_back(corner);
    }
  plane.triangles = {{0, 2, 1}, {1, 2, 3}};
  return plane;
}

constexpr double kDepth_mm = 2.0;

class ToothLightOnAPlane : public ::testing::Test {
 protected:
  ToothLightOnAPlane() { sensor.chip.ambient_level = 0.0; }

  [[nodiscard]] cv::Mat image(const ToothSurface& surface) const {
    const ToothLight light(white_plane(kDepth_mm), {{0.0, 0.0, kDepth_mm}, -Vec3::UnitZ()}, sensor,
                           Pattern::kVertical);
    return light.image(surface);
  }

  /// Light of the middle row: sum, and mean place.
  struct Row {
    double light = 0.0, mean_px = 0.0;
  };
  [[nodiscard]] Row middle_row(const ToothSurface& surface) const {
    const cv::Mat light = image(surface);
    Row row;
    for (int u = 0; u < light.cols; ++u) {
      const double value = light.at<float>(light.rows / 2, u);
      row.light += value;
      row.mean_px += value * u;
    }
    row.mean_px /= row.light;
    return row;
  }

  SensorModel sensor = intraoral_sensor();
};

TEST_F(ToothLightOnAPlane, ASprayedSurfaceGivesTheUsualImageBitForBit) {
  const auto simulator = ImageSimulator::create(white_plane(kDepth_mm), sensor,
                                                {.bits = 16, .noise = false, .motion = false});
  const SensorPath path = SensorPath::from_poses({{0.0, Isometry::Identity()}}).value();
  const cv::Mat usual = simulator->measurement_image(Pattern::kVertical, path, 0.0, 0);
  const cv::Mat light = image({});
  const cv::Mat tooth =
      Chip(sensor.chip)
          .read_out({light, cv::Mat::zeros(light.size(), CV_32FC1)}, {.bits = 16, .noise = false});
  EXPECT_EQ(cv::countNonZero(usual != tooth), 0);
  EXPECT_GT(cv::countNonZero(tooth > 20000), 1000);
}

TEST_F(ToothLightOnAPlane, LightThatEntersIsSpreadAwayFromTheProjector) {
  const ToothSurface bare{0.5, enamel(), {}};
  const Row white = middle_row({});
  const Row row = middle_row(bare);
  const double leaves = SubsurfaceSpread(enamel(), kUpright).total();
  EXPECT_NEAR(row.light / white.light, 0.5 + 0.5 * leaves, 0.05);
  const double side =
      sensor.projector(Pattern::kVertical).center().x() - sensor.camera.center().x();
  EXPECT_LT((row.mean_px - white.mean_px) * side, 0.0);
}

TEST(GlossyFilm, MirrorsWhereItsNormalHalvesTheAngle) {
  const GlossyFilm film;
  const Vec3 to_light = Vec3(std::sin(0.12), 0.0, -std::cos(0.12)), to_camera = -Vec3::UnitZ();
  const Vec3 half = (to_light + to_camera).normalized();
  const double brightest = film.brightness(half, to_light, to_camera);
  EXPECT_NEAR(brightest, film.reflectance / (4.0 * film.slope * film.slope), 0.02 * brightest);
  // One RMS slope away, e times less.
  const Vec3 aside = (half + std::tan(film.slope) * Vec3::UnitY()).normalized();
  EXPECT_NEAR(film.brightness(aside, to_light, to_camera), std::exp(-1.0) * brightest,
              0.02 * brightest);
}

TEST(ToothSurface, ABadNumberIsNamed) {
  EXPECT_THAT(ToothSurface({1.5, {}, {}}).validate().error().message,
              ::testing::HasSubstr("surface_share"));
  EXPECT_THAT(ToothSurface({0.5, {-1.0}, {}}).validate().error().message,
              ::testing::HasSubstr("scattering_per_mm"));
  EXPECT_THAT(ToothSurface({0.5, {}, GlossyFilm{0.02, 0.0}}).validate().error().message,
              ::testing::HasSubstr("slope"));
}

}  // namespace
}  // namespace flytri::simulated
