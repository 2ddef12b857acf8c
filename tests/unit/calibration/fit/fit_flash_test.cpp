#include "core/calibration/fit/fit_flash.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/imaging/srgb.h"
#include "tests/support/perspective_calibration.h"

namespace flytri::calibration {
namespace {

const ImageSize kSize = {640, 480};

Calibration camera() { return testing::perspective_calibration({20, 15, 15}, kSize, 22.0, 80.0); }

std::uint8_t srgb_of(double light) {
  return to_srgb(static_cast<std::uint16_t>(std::lround(65535.0 * std::min(1.0, light))));
}

/// White dots on black at a depth, lit by a function of place and pixel.
template <typename LightAt>
CalibrationPlane draw_plane(double z_mm, const LightAt& light_at) {
  CalibrationPlane plane;
  plane.z_mm = z_mm;
  plane.dots_texture = cv::Mat(kSize.height_px, kSize.width_px, CV_8UC3, cv::Scalar::all(2));
  const Calibration calibration = camera();
  for (int j = -9; j <= 9; ++j) {
    for (int i = -12; i <= 12; ++i) {
      const Vec3 p(i, j, z_mm);
      const Pixel pixel = calibration.project_to_texture(p);
      const Vec3 light = light_at(p, pixel);
      cv::circle(plane.dots_texture, {int(std::lround(pixel.u_px)), int(std::lround(pixel.v_px))},
                 6, cv::Scalar(srgb_of(light[0]), srgb_of(light[1]), srgb_of(light[2])), -1);
    }
  }
  return plane;
}

template <typename LightAt>
std::optional<Flash> fit_drawn(const LightAt& light_at) {
  CalibrationSet set;
  set.volume.size_mm = {20, 15, 15};
  set.dots = {1.0, 0.5, 0.8};
  for (double z_mm = -8.0; z_mm <= 8.0; z_mm += 2.0) {
    set.planes.push_back(draw_plane(z_mm, light_at));
  }
  const Calibration calibration = camera();
  return fit_flash(set, calibration.texture_u_px, calibration.texture_v_px, Workers(2));
}

TEST(FitFlash, FindsTheLampItsColorAndTheVignetting) {
  const Vec3 lamp(6, -12, -70), color(0.6, 0.5, 0.4);
  const double vignetting = 0.1;
  const auto flash = fit_drawn([&](const Vec3& p, const Pixel& pixel) {
    const Vec3 to_lamp = lamp - p;
    const double du = pixel.u_px - 0.5 * kSize.width_px, dv = pixel.v_px - 0.5 * kSize.height_px;
    const double rho2 =
        4.0 * (du * du + dv * dv) / (std::pow(kSize.width_px, 2) + std::pow(kSize.height_px, 2));
    return Vec3(kTargetAlbedo * color * (-to_lamp.normalized().z()) * 1e4 / to_lamp.squaredNorm() *
                (1.0 - vignetting * rho2));
  });
  ASSERT_TRUE(flash.has_value());
  // Eight bits: the light is known to half a percent.
  EXPECT_LT((flash->p_sensor_mm - lamp).norm(), 1.5);
  EXPECT_LT((flash->light - color).norm(), 0.02);
  EXPECT_NEAR(flash->vignetting, vignetting, 0.01);
  EXPECT_LT(flash->residual.rms, 0.005);
}

TEST(FitFlash, AnEvenLightIsNoFlash) {
  EXPECT_FALSE(fit_drawn([](const Vec3&, const Pixel&) { return Vec3(0.5, 0.5, 0.5); }));
}

TEST(FitFlash, SaturatedDotsAreNoFlash) {
  EXPECT_FALSE(fit_drawn([](const Vec3&, const Pixel&) { return Vec3(1.0, 0.5, 0.5); }));
}

}  // namespace
}  // namespace flytri::calibration
