#include "hw/simulated/datasets/simulate_recording.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/geometry/sphere_mesh.h"
#include "core/io/models/ply.h"
#include "core/io/recordings/recording.h"
#include "core/io/recordings/truth.h"
#include "hw/simulated/datasets/simulate_calibration_set.h"
#include "tests/support/temporary_folder.h"

namespace flytri::simulated {
namespace {

// A quarter of the pixels, to be fast; the tests do not depend on their number.
SensorModel small_sensor() {
  SensorModel sensor = intraoral_sensor();
  for (CameraModel* camera : {&sensor.camera, &sensor.texture_camera}) {
    camera->size = {camera->size.width_px / 4, camera->size.height_px / 4};
    camera->focal_px /= 4.0;
    camera->principal_px /= 4.0;
  }
  return sensor;
}

RecordingOptions second_over_a_ball() {
  RecordingOptions options;
  options.sensor = small_sensor();
  options.path.kind = PathKind::kOrbit;
  options.path.duration_s = 1.0;
  options.texture_period_s = 0.5;
  return options;
}

TriangleMesh ball() { return sphere_mesh(Vec3::Zero(), 12.0, 30); }

TEST(SimulateRecording, WritesFramesAndTruePoses) {
  const TemporaryFolder folder;
  const auto counts =
      simulate_recording(ball(), second_over_a_ball(), folder / "scan", Workers(2), Progress());
  ASSERT_TRUE(counts) << counts.error().message;
  EXPECT_EQ(counts->measurement, 29);
  EXPECT_EQ(counts->texture, 2);
  const auto recording = io::open_recording(folder / "scan");
  ASSERT_TRUE(recording) << recording.error().message;
  ASSERT_EQ(recording->frames.size(), 31U);
  EXPECT_EQ(recording->frames[0].kind, FrameKind::kVertical);
  EXPECT_EQ(recording->frames[1].kind, FrameKind::kHorizontal);
  EXPECT_EQ(recording->frames[15].kind, FrameKind::kTexture);
  // The patterns continue to alternate after the texture frame.
  EXPECT_NE(recording->frames[14].kind, recording->frames[16].kind);
  EXPECT_TRUE(io::load_frame(*recording, FrameIndex(15)));
  const auto truth = io::read_truth(folder / "scan" / "truth.json");
  ASSERT_TRUE(truth) << truth.error().message;
  ASSERT_EQ(truth->poses.size(), 31U);
  EXPECT_EQ(truth->poses[4].file, recording->frames[4].file);
  const auto mesh = io::read_ply(truth->mesh);
  ASSERT_TRUE(mesh) << mesh.error().message;
  const auto lit = mesh->extra.find("lit");
  ASSERT_NE(lit, mesh->extra.end());
  const auto dark = std::count(lit->second.begin(), lit->second.end(), 0.0);
  EXPECT_GT(dark, 0);
  EXPECT_LT(static_cast<std::size_t>(dark), lit->second.size());
}

TEST(SimulateRecording, IsBitIdenticalForAnyNumberOfThreads) {
  const TemporaryFolder folder;
  RecordingOptions options = second_over_a_ball();
  options.path.duration_s = 0.2;
  ASSERT_TRUE(simulate_recording(ball(), options, folder / "a", Workers(1), Progress()));
  ASSERT_TRUE(simulate_recording(ball(), options, folder / "b", Workers(2), Progress()));
  const auto a = io::open_recording(folder / "a");
  const auto b = io::open_recording(folder / "b");
  for (std::size_t i = 0; i < a->frames.size(); ++i) {
    const cv::Mat image = io::load_frame(*a, FrameIndex(i))->image;
    const cv::Mat other_image = io::load_frame(*b, FrameIndex(i))->image;
    EXPECT_TRUE(std::equal(image.data, image.data + image.total(), other_image.data));
  }
}

TEST(SimulateRecording, TissueIsInTheImagesButNotInTheTruth) {
  const TemporaryFolder folder;
  RecordingOptions options = second_over_a_ball();
  ASSERT_TRUE(simulate_recording(ball(), options, folder / "clear", Workers(2), Progress()));
  options.faults.tissue_share = 0.4;
  ASSERT_TRUE(simulate_recording(ball(), options, folder / "tissue", Workers(2), Progress()));
  const auto clear = io::open_recording(folder / "clear");
  const auto tissue = io::open_recording(folder / "tissue");
  ASSERT_EQ(clear->frames.size(), tissue->frames.size());
  int differ = 0;
  for (std::size_t i = 0; i < clear->frames.size(); ++i) {
    const cv::Mat one = io::load_frame(*clear, FrameIndex(i))->image;
    const cv::Mat other_image = io::load_frame(*tissue, FrameIndex(i))->image;
    differ += std::equal(one.datastart, one.dataend, other_image.datastart) ? 0 : 1;
  }
  EXPECT_GT(differ, 5);
  EXPECT_LT(differ, 20);
  const auto truth = io::read_truth(folder / "tissue" / "truth.json");
  EXPECT_EQ(io::read_ply(truth->mesh)->mesh.vertices.size(), ball().vertices.size());
}

TEST(SimulateRecording, SimulatesDroppedFramesUnknownPatternsAndALiftedSensor) {
  const TemporaryFolder folder;
  RecordingOptions options = second_over_a_ball();
  options.path.duration_s = 2.0;
  options.texture_period_s = 0.0;
  options.faults = {
      .dropped_share = 0.3, .unknown_patterns = true, .away_start_s = 0.5, .away_duration_s = 1.0};
  const auto counts = simulate_recording(ball(), options, folder / "scan", Workers(2), Progress());
  ASSERT_TRUE(counts) << counts.error().message;
  EXPECT_GT(counts->dropped, 5);
  EXPECT_EQ(counts->dropped + counts->measurement, 61);
  const auto recording = io::open_recording(folder / "scan");
  for (const io::RecordedFrame& frame : recording->frames)
    EXPECT_EQ(frame.kind, FrameKind::kUnknown);
  double farthest_mm = 0.0;
  const auto truth = io::read_truth(folder / "scan" / "truth.json");
  for (const io::TruthPose& pose : truth->poses)
    farthest_mm = std::max(farthest_mm, pose.T_model_sensor.translation().norm());
  // Three volume depths from the surface of the sphere.
  EXPECT_GT(farthest_mm, 45.0);
}

TEST(SimulateRecording, LeavesAShorterRecordingOrNoneWhenCancelled) {
  const TemporaryFolder folder;
  const Progress progress;
  progress.cancel();
  const auto counts =
      simulate_recording(ball(), second_over_a_ball(), folder / "scan", Workers(1), progress);
  ASSERT_FALSE(counts);
  EXPECT_FALSE(std::filesystem::exists(folder / "scan" / "recording.json"));
}

TEST(SimulateRecording, RefusesBadOptions) {
  const TemporaryFolder folder;
  RecordingOptions options = second_over_a_ball();
  options.faults.dropped_share = 2.0;
  const auto counts = simulate_recording(ball(), options, folder / "scan", Workers(1), Progress());
  ASSERT_FALSE(counts);
  EXPECT_NE(counts.error().message.find("dropped_share"), std::string::npos);
}

TEST(SimulateCalibrationSet, HasPlanesThroughTheWholeVolume) {
  const auto set =
      take_calibration_set({.sensor = small_sensor(), .exposures = 2}, Workers(2), Progress());
  ASSERT_TRUE(set) << set.error().message;
  ASSERT_EQ(set->planes.size(), 17U);
  EXPECT_DOUBLE_EQ(set->planes.front().z_mm, -8.0);
  EXPECT_DOUBLE_EQ(set->planes.back().z_mm, 8.0);
  EXPECT_EQ(set->line_counts[0], 10);
  for (const calibration::CalibrationPlane& plane : set->planes) {
    EXPECT_EQ(plane.vertical.type(), CV_16UC1);
    EXPECT_EQ(plane.dots_texture.type(), CV_8UC3);
  }
}

TEST(SimulateCalibrationSet, DotsAreOnTheirGrid) {
  const SensorModel sensor = intraoral_sensor();
  const auto set =
      take_calibration_set({.sensor = sensor, .plane_count = 5, .exposures = 1, .noise = false},
                           Workers(2), Progress())
          .value();
  const cv::Mat& dots = set.planes[2].dots;
  const auto value_at = [&](double x_mm, double y_mm) {
    const Pixel pixel = sensor.camera.project({x_mm, y_mm, 0.0}).value();
    return dots.at<std::uint16_t>(static_cast<int>(std::lround(pixel.v_px)),
                                  static_cast<int>(std::lround(pixel.u_px)));
  };
  EXPECT_GT(value_at(3.0, -2.0), 40000);
  EXPECT_LT(value_at(3.5, -2.5), 8000);
  // Markers are larger than other dots.
  EXPECT_GT(value_at(1.33, 0.0), 30000);
  EXPECT_LT(value_at(2.40, 0.0), 8000);
}

}  // namespace
}  // namespace flytri::simulated
