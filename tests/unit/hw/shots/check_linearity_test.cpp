#include "hw/shots/check_linearity.h"

#include <gmock/gmock.h>

#include <cmath>

#include "tests/support/simulated_rig.h"

namespace flytri::shots {
namespace {

using ::testing::HasSubstr;

rig::RigSettings rig_settings() {
  rig::RigSettings rig;
  rig.measurement.settings.exposure_s = 0.01;
  rig.texture.emplace().settings.exposure_s = 0.01;
  return rig;
}

/// A white sheet that the flash lights; its gray value follows the exposure by a gamma.
simulated::SimulatedCamera::Scene sheet(double exposure_s, double gamma, int type) {
  const double gray = 200.0 * std::pow(exposure_s / 0.02, gamma);
  return [=](device::Light light, double) {
    return cv::Mat(48, 64, type,
                   light == device::Light::kFlash ? cv::Scalar::all(gray) : cv::Scalar::all(2.0));
  };
}

/// Simulated devices; the measurement camera has a gamma.
class SheetRig {
 public:
  explicit SheetRig(double gamma) : gamma_(gamma) {}

  rig::RigDevices open(const rig::RigSettings& rig) {
    const double exposure_s = *rig.measurement.settings.exposure_s;
    return {camera(rig.measurement, sheet(exposure_s, gamma_, CV_8UC1)),
            camera(*rig.texture, sheet(exposure_s, 1.0, CV_8UC3)), lights, clock.clock()};
  }

  testing::ManualClock clock;
  std::shared_ptr<simulated::SimulatedLights> lights = std::make_shared<simulated::SimulatedLights>(
      simulated::SimulatedLightsOptions{}, clock.clock());

 private:
  std::shared_ptr<device::Camera> camera(const rig::RigCamera& camera,
                                         simulated::SimulatedCamera::Scene scene) {
    simulated::SimulatedCameraOptions options;
    options.settings = camera.settings;
    return std::make_shared<simulated::SimulatedCamera>(options, std::move(scene), lights,
                                                        clock.clock());
  }
  const double gamma_;
};

Result<std::vector<LinearityReport>> check(SheetRig& devices, const rig::RigSettings& rig) {
  return check_linearity(
      rig,
      [&](const rig::RigSettings& step) { return Result<rig::RigDevices>(devices.open(step)); },
      {});
}

TEST(CheckLinearity, NamesTheCameraThatIsNotLinear) {
  SheetRig devices(0.6);
  const auto reports = check(devices, rig_settings());
  ASSERT_TRUE(reports) << reports.error().message;
  ASSERT_EQ(reports->size(), 2U);
  EXPECT_THAT(advice_on((*reports)[0]), HasSubstr("is not linear"));
  EXPECT_THAT(advice_on((*reports)[0]), HasSubstr("gamma"));
  EXPECT_EQ(advice_on((*reports)[1]), "");
}

TEST(CheckLinearity, KeepsTheLimitsOfTheFlash) {
  SheetRig devices(1.0);
  ASSERT_TRUE(check(devices, rig_settings()));
  // The switch reports what it refused since its last start; the account goes on over all steps.
  const double now_s = devices.clock.now_s();
  const double begin_s = 100.0;
  const double lit_s = devices.lights->truth(begin_s, now_s).lit(device::Light::kFlash);
  EXPECT_LE(lit_s, 0.25 * (now_s - begin_s) + 0.75 * 2.0);
}

TEST(CheckLinearity, NeedsTheExposures) {
  SheetRig devices(1.0);
  rig::RigSettings rig = rig_settings();
  rig.texture->settings.exposure_s.reset();
  EXPECT_THAT(check(devices, rig).error().message, HasSubstr("exposure_s"));
}

}  // namespace
}  // namespace flytri::shots
