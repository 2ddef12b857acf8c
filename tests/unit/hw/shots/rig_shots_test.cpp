#include "hw/shots/rig_shots.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/simulated_rig.h"

namespace flytri::shots {
namespace {

using ::testing::HasSubstr;
using testing::make_simulated_rig;
using testing::SimulatedRig;
using testing::striped_scene;

constexpr double kNoise = 0.02;

SimulatedRig make_rig() {
  testing::SimulatedRigOptions options;
  options.measurement.latency_s =
      0.1;  // three frames, so that frames arriving right after a switch are older
  options.texture.latency_s = 0.1;
  options.measurement.noise = kNoise;
  return make_simulated_rig(options);
}

std::unique_ptr<RigShots> make_shots(const SimulatedRig& rig) {
  return RigShots::create({rig.measurement, rig.texture, rig.lights, rig.clock.clock()}, "rig")
      .value();
}

/// Mean absolute difference, share of full scale.
double difference(const cv::Mat& image, const cv::Mat& scene) {
  cv::Mat expected;
  scene.convertTo(expected, image.type(), image.depth() == CV_16U ? 257.0 : 1.0);
  const double scale = image.depth() == CV_16U ? 65535.0 : 255.0;
  return cv::norm(image, expected, cv::NORM_L1) / scale / static_cast<double>(image.total());
}

TEST(RigShots, EachShotShowsOnlyItsLight) {
  const SimulatedRig rig = make_rig();
  const auto shots = make_shots(rig);
  ASSERT_TRUE(shots->start().has_value());
  using enum calibration::ShotKind;
  for (const auto& [kind, light] :
       std::initializer_list<std::pair<calibration::ShotKind, device::Light>>{
           {kDark, device::Light::kDark},
           {kVertical, device::Light::kVertical},
           {kHorizontal, device::Light::kHorizontal},
           {kVerticalAgain, device::Light::kVertical},
           {kDots, device::Light::kFlash}}) {
    const auto image = shots->take(kind, 0.0, {});
    ASSERT_TRUE(image.has_value()) << image.error().message;
    EXPECT_EQ(image->type(), CV_16UC1);
    // Sixteen exposures reduce the noise to a quarter; another light would differ by a tenth.
    EXPECT_LT(difference(*image, striped_scene(light, 0.0)), 0.3 * kNoise) << to_string(kind);
  }
  const auto color = shots->take(kDotsTexture, 0.0, {});
  ASSERT_TRUE(color.has_value());
  EXPECT_EQ(color->type(), CV_8UC3);
  EXPECT_LT(difference(*color, testing::colored_scene(device::Light::kFlash, 0.0)), 0.01);
}

TEST(RigShots, LightsAreDarkAfterStop) {
  SimulatedRig rig = make_rig();
  {
    const auto shots = make_shots(rig);
    ASSERT_TRUE(shots->start().has_value());
    ASSERT_TRUE(shots->take(calibration::ShotKind::kVertical, 0.0, {}).has_value());
  }
  EXPECT_EQ(rig.lights->status().state, device::LightSwitchState::kIdle);
}

/// How long lights were on in the last `window_s`.
double lit_s(const SimulatedRig& rig, double window_s) {
  const double now_s = rig.clock.now_s();
  return window_s - rig.lights->truth(now_s - window_s, now_s).lit(device::Light::kDark);
}

// The dialog waits for the user, with the dots in place.
TEST(RigShots, LightsAreDarkBetweenShots) {
  SimulatedRig rig = make_rig();
  const auto shots = make_shots(rig);
  ASSERT_TRUE(shots->start().has_value());
  using enum calibration::ShotKind;
  for (const auto kind : {kVertical, kHorizontal, kDots, kDotsTexture}) {
    ASSERT_TRUE(shots->take(kind, 0.0, {}).has_value());
    rig.clock.turn(60.0);
    EXPECT_LT(lit_s(rig, 60.0), 0.01) << to_string(kind);
  }
}

TEST(RigShots, LightsAreDarkAfterACameraFailed) {
  SimulatedRig rig = make_rig();
  const auto shots = make_shots(rig);
  ASSERT_TRUE(shots->start().has_value());
  rig.measurement->set_plugged(false);
  ASSERT_FALSE(shots->take(calibration::ShotKind::kDots, 0.0, {}).has_value());
  rig.clock.turn(60.0);
  EXPECT_LT(lit_s(rig, 60.0), 0.01);
}

TEST(RigShots, AShotThatALimitInterruptsShowsOnlyItsLight) {
  testing::SimulatedRigOptions options;
  options.measurement.noise = kNoise;
  // Less than the exposures of a shot: half a second, beside 0.4 s to settle.
  options.lights.limits.flash = {0.6, 0.3};
  const SimulatedRig rig = make_simulated_rig(options);
  const auto shots = make_shots(rig);
  ASSERT_TRUE(shots->start().has_value());
  const auto image = shots->take(calibration::ShotKind::kDots, 0.0, {});
  ASSERT_TRUE(image.has_value()) << image.error().message;
  EXPECT_GT(rig.lights->status().limited, 0);
  EXPECT_LT(difference(*image, striped_scene(device::Light::kFlash, 0.0)), 0.3 * kNoise);
}

// The window shows the camera's image while the user moves the target: many looks in a row.
TEST(RigShots, LooksKeepTheDutyWithoutReachingALimit) {
  const SimulatedRig rig = make_rig();
  const auto shots = make_shots(rig);
  ASSERT_TRUE(shots->start().has_value());
  for (const auto kind : {calibration::ShotKind::kDots, calibration::ShotKind::kVertical}) {
    const double begin_s = rig.clock.now_s();
    while (rig.clock.now_s() < begin_s + 2.0) {
      ASSERT_TRUE(shots->look(kind, 0.0, {}).has_value());
      rig.clock.clock().sleep_s(0.03);
    }
  }
  EXPECT_EQ(rig.lights->status().limited, 0);
}

TEST(RigShots, ReportsAnUnpluggedCamera) {
  const SimulatedRig rig = make_rig();
  const auto shots = make_shots(rig);
  ASSERT_TRUE(shots->start().has_value());
  rig.measurement->set_plugged(false);
  const auto image = shots->take(calibration::ShotKind::kVertical, 0.0, {});
  ASSERT_FALSE(image.has_value());
  EXPECT_THAT(image.error().message, HasSubstr("plug it in again"));
  rig.measurement->set_plugged(true);
  EXPECT_TRUE(shots->take(calibration::ShotKind::kVertical, 0.0, {}).has_value());
}

TEST(RigShots, ReportsAnUnpluggedLightSwitch) {
  const SimulatedRig rig = make_rig();
  const auto shots = make_shots(rig);
  ASSERT_TRUE(shots->start().has_value());
  rig.lights->set_plugged(false);
  const auto image = shots->take(calibration::ShotKind::kVertical, 0.0, {});
  ASSERT_FALSE(image.has_value());
  EXPECT_EQ(image.error().code, ErrorCode::kNotFound);
}

TEST(RigShots, TakesAllButTheDotsInColorWithoutATextureCamera) {
  SimulatedRig rig = make_rig();
  const auto shots =
      RigShots::create({rig.measurement, nullptr, rig.lights, rig.clock.clock()}, "rig").value();
  ASSERT_TRUE(shots->start());
  EXPECT_TRUE(shots->take(calibration::ShotKind::kVertical, 0.0, {}));
  const auto dots = shots->take(calibration::ShotKind::kDotsTexture, 0.0, {});
  ASSERT_FALSE(dots);
  EXPECT_EQ(dots.error().code, ErrorCode::kBadOption);
  EXPECT_THAT(dots.error().message, HasSubstr("no texture camera"));
}

TEST(RigShots, WithoutATextureCameraALampLightsTheDots) {
  const SimulatedRig rig = make_rig();
  const auto shots =
      RigShots::create({rig.measurement, nullptr, rig.lights, rig.clock.clock()}, "rig").value();
  EXPECT_FALSE(shots->has_texture());
  ASSERT_TRUE(shots->start());
  const auto dots = shots->take(calibration::ShotKind::kDots, 0.0, {});
  ASSERT_TRUE(dots.has_value()) << dots.error().message;
  EXPECT_LT(difference(*dots, striped_scene(device::Light::kDark, 0.0)), 0.3 * kNoise);
}

}  // namespace
}  // namespace flytri::shots
