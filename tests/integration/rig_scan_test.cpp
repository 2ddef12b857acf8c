/// @file  A whole simulated rig, from the lights to the model: records simulated cameras under
/// simulated lights, and reconstructs the recording.
#include <gtest/gtest.h>

#include <cmath>

#include "assets/sample_jaw/sample_jaw.h"
#include "core/evaluation/best_fit.h"
#include "core/evaluation/surface_error.h"
#include "core/io/recordings/frame_kind.h"
#include "core/reconstruct/reconstruct.h"
#include "hw/recording/recorder_sensor.h"
#include "hw/simulated/datasets/sensor_calibration.h"
#include "hw/simulated/devices/lit_scene.h"
#include "tests/support/simulated_rig.h"
#include "tests/support/temporary_folder.h"

namespace flytri {
namespace {

using testing::make_simulated_rig;
using testing::SimulatedRig;
using testing::SimulatedRigOptions;

/// The hand rests at the start for this time, while the rig learns the latency of both cameras.
constexpr double kRest_s = 2.4;
constexpr double kScan_s = 2.2;
/// Start time of the simulated clock.
constexpr double kStart_s = 100.0;

/// The images of both cameras; the hand starts to move after a while.
class Stage {
 public:
  explicit Stage(const TriangleMesh& jaw)
      : scene_(simulated::LitScene::create(
                   jaw, simulated::intraoral_sensor(),
                   {.kind = simulated::PathKind::kQuadrant, .duration_s = 10.0},
                   {.tracing = simulated::Tracing::kGrid})
                   .value()),
        dark_(scene_.measurement_image(device::Light::kDark, 0.0)) {}

  /// The image of a perfect rig.
  [[nodiscard]] cv::Mat measurement(device::Light light, double time_s) const {
    return light == device::Light::kDark ? dark_ : scene_.measurement_image(light, path_s(time_s));
  }
  [[nodiscard]] cv::Mat texture(device::Light light, double time_s) const {
    return scene_.texture_image(light, path_s(time_s));
  }
  [[nodiscard]] Isometry T_model_sensor(double time_s) const {
    return scene_.path().T_model_sensor(path_s(time_s));
  }

 private:
  static double path_s(double time_s) { return time_s - kStart_s - kRest_s; }

  simulated::LitScene scene_;
  cv::Mat dark_;  // the same at all times, as dark frames are not used
};

SimulatedRigOptions rig_of(const Stage& stage) {
  const simulated::SensorModel sensor = simulated::intraoral_sensor();
  SimulatedRigOptions options;
  options.measurement.settings.size = sensor.camera.size;
  options.measurement.exposure_s = sensor.exposure_s;
  options.measurement.latency_s = 0.05;
  options.measurement.jitter_s = 0.002;
  options.texture.settings.size = sensor.texture_camera.size;
  options.texture.settings.channels = device::Channels::kRgb;
  options.texture.latency_s = 0.07;
  options.texture.phase_s = 0.011;
  options.measurement_scene = [&stage](device::Light light, double time_s) {
    return stage.measurement(light, time_s);
  };
  options.texture_scene = [&stage](device::Light light, double time_s) {
    return stage.texture(light, time_s);
  };
  return options;
}

void record(const SimulatedRig& rig, const std::filesystem::path& folder) {
  const auto recorder = recording::RecorderSensor::create(rig.sensor, folder).value();
  ASSERT_TRUE(recorder->start());
  while (rig.clock.now_s() < kStart_s + kRest_s + kScan_s) {
    ASSERT_TRUE(recorder->next(0.05));
    while (recorder->work_in_background(0.0)) {
    }
  }
  recorder->stop();
  EXPECT_EQ(recorder->recorder_status().lost, 0);
}

/// The middle of the exposure that is nearest to the learned time of a frame.
double exposed_s(const SimulatedRig& rig, const Frame& frame) {
  const simulated::SimulatedCamera& camera =
      frame.kind == FrameKind::kTexture ? *rig.texture : *rig.measurement;
  const double period_s = 1.0 / camera.read_back().rate_hz;
  const double since_s = kStart_s + frame.time_s - camera.exposure(0).middle_s;
  return camera.exposure(std::llround(since_s / period_s)).middle_s;
}

/// The image under only the light of its label.
cv::Mat true_image(const Frame& frame, const SimulatedRig& rig, const Stage& stage) {
  const double time_s = exposed_s(rig, frame);
  if (frame.kind == FrameKind::kTexture) return stage.texture(device::Light::kFlash, time_s);
  return stage.measurement(
      frame.kind == FrameKind::kVertical ? device::Light::kVertical : device::Light::kHorizontal,
      time_s);
}

struct FrameCounts {
  int measurement = 0, texture = 0;
};

/// A label may let 2 % of another light through, of at most 120 gray values.
constexpr double kMixed = 2.0;

/// Checks that each frame is the image under only its light.
FrameCounts expect_true(const io::Recording& recording, const SimulatedRig& rig,
                        const Stage& stage) {
  FrameCounts counts;
  for (std::size_t i = 0; i < recording.frames.size(); ++i) {
    const Frame frame = io::load_frame(recording, FrameIndex(i)).value();
    ++(frame.kind == FrameKind::kTexture ? counts.texture : counts.measurement);
    EXPECT_LE(cv::norm(frame.image, true_image(frame, rig, stage), cv::NORM_INF), kMixed)
        << "frame " << i << ", " << io::to_string(frame.kind) << ", at " << frame.time_s << " s";
  }
  return counts;
}

/// Pose of the world frame of the result, which is the frame of the first view.
Isometry first_pose(const io::Recording& recording, const SimulatedRig& rig, const Stage& stage) {
  for (std::size_t i = 0;; ++i) {
    const Frame frame = io::load_frame(recording, FrameIndex(i)).value();
    if (pattern_of(frame.kind)) return stage.T_model_sensor(exposed_s(rig, frame));
  }
}

TEST(RigScan, ReconstructsAsAccuratelyAsTheSensorMeasures) {
  const Workers workers;
  const TriangleMesh jaw = sample_jaw::make_sample_jaw({}, workers).value();
  const Stage stage(jaw);
  const SimulatedRig rig = make_simulated_rig(rig_of(stage));
  const TemporaryFolder folder;
  ASSERT_NO_FATAL_FAILURE(record(rig, folder / "scan"));
  const io::Recording recording = io::open_recording(folder / "scan").value();
  // Sometimes the lights are off, and some frames are texture frames.
  const FrameCounts counts = expect_true(recording, rig, stage);
  EXPECT_GT(counts.measurement, 30.0 * kScan_s * 0.85);
  EXPECT_GE(counts.texture, 2);

  const calibration::Calibration calibration =
      simulated::calibrate_virtual_sensor(simulated::intraoral_sensor(), workers, {}).value();
  const reconstruct::Reconstruction result =
      reconstruct::reconstruct(recording, calibration, {}, workers, {}).value();
  int textured = 0, rejected = 0;
  for (const reconstruct::FrameReport& report : result.frames) {
    textured += report.fate == reconstruct::FrameFate::kTextured ? 1 : 0;
    rejected += report.fate == reconstruct::FrameFate::kRejected ? 1 : 0;
  }
  EXPECT_GE(textured, 2);
  EXPECT_EQ(rejected, 0);
  const TriangleMesh placed =
      evaluation::transformed(result.surface.mesh, first_pose(recording, rig, stage));
  const evaluation::BestFit fit = evaluation::best_fit(placed, jaw, {}, workers).value();
  const evaluation::SurfaceError error =
      evaluation::surface_error(evaluation::transformed(placed, fit.T_truth_result), jaw, {}, {},
                                workers)
          .value();
  // The paper's figure for a whole jaw.
  EXPECT_LT(error.distance.rms_mm, 0.032);
  EXPECT_LT(fit.T_truth_result.translation().norm(), 0.1);
}

TEST(RigScan, DoesNotRecordFramesInWhichTheLightChanged) {
  const TriangleMesh jaw = sample_jaw::make_sample_jaw({}, Workers()).value();
  const Stage stage(jaw);
  SimulatedRigOptions options = rig_of(stage);
  // Almost the whole period: there is no gap for switching, so every other frame has two lights.
  options.measurement.exposure_s = 0.03;
  const SimulatedRig rig = make_simulated_rig(options);
  const TemporaryFolder folder;
  ASSERT_NO_FATAL_FAILURE(record(rig, folder / "scan"));
  const io::Recording recording = io::open_recording(folder / "scan").value();
  const FrameCounts counts = expect_true(recording, rig, stage);
  EXPECT_GT(counts.measurement, 30.0 * kScan_s * 0.35);
  EXPECT_GT(rig.sensor->rig_status().measurement.labels.straddled, 20);
}

}  // namespace
}  // namespace flytri
