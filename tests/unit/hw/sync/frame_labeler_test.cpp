#include "hw/sync/frame_labeler.h"

#include <gtest/gtest.h>

#include "app/lab/label_trial.h"
#include "tests/support/simulated_rig.h"

namespace flytri::sync {
namespace {

constexpr double kCameraPeriod_s = 1.0 / 30.0;

lab::LabelTrialOptions usual() {
  lab::LabelTrialOptions options;
  options.camera.noise = 0.004;
  options.camera.latency_s = 1.3 * kCameraPeriod_s;
  options.duration_s = 9.0;
  return options;
}

lab::LabelTrialResult run(
    const lab::LabelTrialOptions& options,
    const simulated::SimulatedCamera::Scene& of_light = testing::striped_scene) {
  return lab::run_label_trial(options, of_light).value();
}

void expect_all_right(const lab::LabelTrialResult& result, double in_step_within_s) {
  ASSERT_TRUE(result.in_step_after_s);
  EXPECT_LT(*result.in_step_after_s, in_step_within_s);
  EXPECT_EQ(result.wrong, 0);
  // At most one frame is lost, when the plan changes from two frames per pattern to one.
  EXPECT_GE(result.right, result.whole - 1);
  EXPECT_GT(result.whole, 100);
  EXPECT_LT(result.largest_mixture, 0.1);
}

TEST(FrameLabeler, LabelsAllUnmixedFramesForAnyLatency) {
  for (const double periods : {0.0, 0.37, 1.0, 1.5, 2.2, 3.0, 4.5, 7.8, 12.0}) {
    SCOPED_TRACE(periods);
    lab::LabelTrialOptions options = usual();
    options.camera.latency_s = periods * kCameraPeriod_s;
    const lab::LabelTrialResult result = run(options);
    expect_all_right(result, 4.0);
    // The plan needs the latency to 1/8 period.
    EXPECT_NEAR(result.latency_error_s, 0.0, kCameraPeriod_s / 8.0);
    EXPECT_EQ(result.fault, LightFault::kNone);
  }
}

// A latency outside of what is searched looks like another one, shifted by two frames or with
// swapped patterns, for as long as the lights only alternate.
TEST(FrameLabeler, RefusesALatencyThatItDoesNotSearch) {
  for (const double periods : {5.3, 6.0, 7.0, 9.5}) {
    SCOPED_TRACE(periods);
    lab::LabelTrialOptions options = usual();
    options.labeler.latency.max_latency_periods = 4.0;
    options.camera.latency_s = periods * kCameraPeriod_s;
    const lab::LabelTrialResult result = run(options);
    EXPECT_EQ(result.wrong, 0);
    EXPECT_EQ(result.right, 0);
    EXPECT_FALSE(result.in_step_after_s);
    EXPECT_EQ(result.fault, LightFault::kUnrelated);
  }
}

TEST(FrameLabeler, KeepsALatencyThroughASecondOfMisleadingImages) {
  const lab::LabelTrialResult result = run(usual(), [](device::Light light, double time_s) {
    const bool is_misled = time_s > 105.0 && time_s < 105.7;
    return testing::striped_scene(is_misled ? device::Light::kVertical : light, time_s);
  });
  EXPECT_EQ(result.wrong, 0);
  EXPECT_GT(result.right, result.whole - 40);
  EXPECT_EQ(result.fault, LightFault::kNone);
}

TEST(FrameLabeler, LosesNoLabelsByJitterAndDroppedFrames) {
  lab::LabelTrialOptions options = usual();
  options.camera.jitter_s = 0.006;
  options.camera.dropped_share = 0.1;
  expect_all_right(run(options), 4.0);
}

TEST(FrameLabeler, UsesTwoFramesPerPatternForARollingShutter) {
  lab::LabelTrialOptions options = usual();
  options.camera.exposure_s = 0.01;
  options.camera.readout_s = 0.02;
  const lab::LabelTrialResult result = run(options);
  expect_all_right(result, 6.0);
  EXPECT_GT(result.whole, result.straddled / 2);
}

TEST(FrameLabeler, LabelsByTimeIfNoObjectIsVisible) {
  lab::LabelTrialOptions options = usual();
  const lab::LabelTrialResult result = run(options, [](device::Light light, double time_s) {
    return testing::striped_scene(time_s > 104.0 && time_s < 109.0 ? device::Light::kDark : light,
                                  time_s);
  });
  expect_all_right(result, 4.0);
}

TEST(FrameLabeler, ReportsSwappedCablesAndLabelsFramesByWhatTheyShow) {
  lab::LabelTrialOptions options = usual();
  options.lights.faults.is_swapped = true;
  const lab::LabelTrialResult result = run(options);
  expect_all_right(result, 4.0);
  EXPECT_EQ(result.fault, LightFault::kSwapped);
}

TEST(FrameLabeler, ReportsASwitchWithoutEffect) {
  lab::LabelTrialOptions options = usual();
  options.lights.faults.is_mute = true;
  const lab::LabelTrialResult nothing = run(options);
  EXPECT_EQ(nothing.fault, LightFault::kNothingSeen);
  EXPECT_EQ(nothing.wrong, 0);
  // The switch stopped working while a pattern was on.
  const lab::LabelTrialResult stuck = run(options, [](device::Light, double time_s) {
    return testing::striped_scene(device::Light::kVertical, time_s);
  });
  EXPECT_EQ(stuck.fault, LightFault::kStuck);
}

TEST(FrameLabeler, ReportsAProjectorThatIsAlwaysDark) {
  lab::LabelTrialOptions options = usual();
  options.lights.faults.no_horizontal = true;
  EXPECT_EQ(run(options).fault, LightFault::kNoHorizontal);
  options.lights.faults = {.no_vertical = true};
  EXPECT_EQ(run(options).fault, LightFault::kNoVertical);
  options.lights.faults = {.no_flash = true};
  EXPECT_EQ(run(options).fault, LightFault::kNoFlash);
}

TEST(FrameLabeler, AnEvenSurfaceUnderTheFlashIsNoMissingFlash) {
  const auto even = [](device::Light light, double time_s) {
    const cv::Mat image = testing::striped_scene(light, time_s);
    if (light != device::Light::kFlash) return image;
    return cv::Mat(image.size(), image.type(), cv::Scalar(140));
  };
  EXPECT_EQ(run(usual(), even).fault, LightFault::kNone);
}

TEST(FrameLabeler, AdaptsToADriftingLatency) {
  // The camera's clock is wrong by 0.33 %: the true period is learned.
  lab::LabelTrialOptions options = usual();
  options.camera.settings.rate_hz = 30.1;
  expect_all_right(run(options), 4.0);
}

TEST(FrameLabeler, HasAMessageForEveryFault) {
  for (const LightFault fault : {LightFault::kSwapped, LightFault::kStuck, LightFault::kNoVertical,
                                 LightFault::kNoHorizontal, LightFault::kNoFlash})
    EXPECT_NE(message_of(fault).find("cable"), std::string::npos);
  EXPECT_TRUE(message_of(LightFault::kNone).empty());
}

TEST(FrameLabeler, RefusesBadOptions) {
  LabelerOptions options;
  options.pure_share = 0.3;
  EXPECT_FALSE(FrameLabeler::create(options));
  options = {};
  options.latency.max_latency_periods = 0.0;
  EXPECT_FALSE(FrameLabeler::create(options));
}

}  // namespace
}  // namespace flytri::sync
