#include "core/reconstruct/finish_scan.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/orthographic_calibration.h"
#include "tests/support/point_bits.h"
#include "tests/support/scan_scene.h"

namespace flytri::reconstruct {
namespace {

using testing::bits_in_ball;

const std::vector<std::string> kSteps = {"Aligning the scan", "Calculating normals", "Simplifying",
                                         "Meshing", "Texturing"};

/// A small scan with texture; sensor and texture camera look along z.
class FinishScan : public ::testing::Test {
 protected:
  static constexpr int kViews = 16;

  Result<FinishedScan> finish(const Progress& progress) const {
    return finish(progress, texture_image());
  }
  static cv::Mat texture_image() { return {480, 640, CV_8UC3, cv::Scalar(200, 150, 100)}; }

  /// @param second  image of the second texture frame
  Result<FinishedScan> finish(const Progress& progress, const cv::Mat& second) const {
    ScannedViews scanned;
    scanned.views = scan_.views;
    scanned.calibration = &calibration_;
    Frame frame;
    frame.index = FrameIndex(kViews);
    frame.time_s = 0.5 * kViews / 30.0;
    frame.image = texture_image();
    scanned.texture_frames = {frame, frame};
    scanned.texture_frames[1].image = second;
    FinishOptions options;
    options.atlas.max_side_px = 512;
    StageClock clock({});
    return finish_scan(scanned, options, Workers(1), progress, clock);
  }

  const testing::TrueScan scan_ = testing::scan_cusps(kViews, {.points_per_line = 150}, 1);
  const calibration::Calibration calibration_ =
      testing::orthographic_calibration({20, 15, 15}, {640, 480}, 25.0);
};

TEST_F(FinishScan, ReportsEveryStageAndNeverGoesBack) {
  std::vector<Progress::Snapshot> told;
  const auto finished = finish(Progress([&](const auto& step) { told.push_back(step); }));
  ASSERT_TRUE(finished.has_value()) << finished.error().message;
  std::vector<std::string> steps;
  double last = 0.0;
  for (const Progress::Snapshot& now : told) {
    EXPECT_GE(now.fraction, 0.0);
    EXPECT_LE(now.fraction, 1.0);
    if (steps.empty() || now.stage != steps.back()) {
      EXPECT_TRUE(steps.empty() || last > 0.99) << steps.back() << " ends at " << last;
      steps.push_back(now.stage);
      last = 0.0;
    }
    EXPECT_GE(now.fraction, last) << now.stage;
    // No single advance is most of a stage, so that the progress bar moves.
    EXPECT_LT(now.fraction - last, 0.75) << now.stage;
    last = now.fraction;
  }
  EXPECT_GT(last, 0.99);
  EXPECT_EQ(steps, kSteps);
}

TEST_F(FinishScan, StopsInTheStageInWhichItIsCanceled) {
  for (const std::string& step : kSteps) {
    for (const double fraction : {0.0, 0.3, 0.8}) {
      Progress progress;
      std::vector<std::string> told_after;
      const Progress watched([&](const Progress::Snapshot& told) {
        if (progress.cancelled()) told_after.push_back(told.stage);
        if (told.stage == step && told.fraction >= fraction) progress.cancel();
      });
      progress = watched;
      const auto finished = finish(progress);
      ASSERT_FALSE(finished.has_value()) << step;
      EXPECT_EQ(finished.error().code, ErrorCode::kCancelled);
      // One thread: the running task is finished, no other task starts.
      EXPECT_LE(told_after.size(), 2U) << step << " at " << fraction;
      for (const std::string& stage : told_after) EXPECT_EQ(stage, step);
    }
  }
}

TEST_F(FinishScan, WhatWasTrimmedAwayHasNoColorInTheModel) {
  const auto middle_s = [](int view) { return (view + 0.5) / 30.0; };
  constexpr int kLastBefore = kViews / 2 - 1;
  editing::EditStack edits;
  edits.push({editing::EditKind::kTrim,
              scan_.views[kLastBefore].view->time_s,
              {{Vec3f::Zero(), -Vec3f::UnitZ(), 3.0F}}});
  ScannedViews scanned;
  scanned.views = scan_.views;
  scanned.calibration = &calibration_;
  scanned.edits = edits.state();
  Frame old_frame, new_frame;
  old_frame.time_s = middle_s(2);
  old_frame.image = cv::Mat(480, 640, CV_8UC3, cv::Scalar(200, 40, 40));
  new_frame.time_s = middle_s(12);
  new_frame.image = cv::Mat(480, 640, CV_8UC3, cv::Scalar(40, 40, 200));
  scanned.texture_frames = {old_frame, new_frame};
  FinishOptions options;
  options.atlas.max_side_px = 512;
  StageClock clock({});
  const auto finished = finish_scan(scanned, options, Workers(1), {}, clock);
  ASSERT_TRUE(finished.has_value()) << finished.error().message;
  int inside = 0, red_inside = 0, red_outside = 0;
  for (const SurfacePoint& point : finished->points) {
    const bool is_inside = point.position_mm.norm() < 2.9F;
    const bool is_red = point.color[0] > point.color[2];
    inside += is_inside ? 1 : 0;
    red_inside += is_inside && is_red ? 1 : 0;
    red_outside += !is_inside && is_red ? 1 : 0;
  }
  EXPECT_GT(inside, 50);
  EXPECT_EQ(red_inside, 0);
  EXPECT_GT(red_outside, 100);
}

/// A scan that goes on after it was finished, with a lock on a part of it.
class FinishScanAgain : public FinishScan {
 protected:
  static constexpr float kLocked_mm = 4.0F;
  /// Vertices farther inside depend on locked points alone: the mesh has a spacing of 0.4 mm here.
  static constexpr float kInside_mm = 1.8F;

  static Frame texture(double time_s, const cv::Scalar& color) {
    Frame frame;
    frame.time_s = time_s;
    frame.image = cv::Mat(480, 640, CV_8UC3, color);
    return frame;
  }
  [[nodiscard]] ScannedViews first_half() const {
    ScannedViews scanned;
    scanned.views.assign(scan_.views.begin(), scan_.views.begin() + kViews / 2);
    scanned.calibration = &calibration_;
    scanned.texture_frames = {texture(2.5 / 30.0, {200, 150, 100})};
    return scanned;
  }
  /// All views, which start from poses with errors, and a much brighter frame.
  [[nodiscard]] ScannedViews whole() const {
    ScannedViews scanned = first_half();
    scanned.views = testing::with_drift(scan_.views, 0.03, 5);
    scanned.texture_frames.push_back(texture(12.5 / 30.0, {240, 220, 180}));
    return scanned;
  }
  [[nodiscard]] static FinishedScan finished(ScannedViews scanned) {
    FinishOptions options;
    options.atlas.max_side_px = 512;
    StageClock clock({});
    return finish_scan(scanned, options, Workers(2), {}, clock).value();
  }
  /// The whole scan, after its first half was finished and a part of that locked.
  struct Locked {
    FinishedScan before;
    Vec3f middle_mm = Vec3f::Zero();  ///< of the lock
    ScannedViews scanned;
  };
  [[nodiscard]] Locked lock_first_half() const {
    Locked locked{finished(first_half()), Vec3f::Zero(), whole()};
    const PointCloud& points = locked.before.points;
    locked.middle_mm =
        std::min_element(points.begin(), points.end(), [](const auto& a, const auto& b) {
          return a.position_mm.norm() < b.position_mm.norm();
        })->position_mm;
    editing::EditStack edits;
    edits.push({editing::EditKind::kLock,
                locked.before.held->seen_until_s,
                {{locked.middle_mm, -Vec3f::UnitZ(), kLocked_mm}}});
    locked.scanned.edits = edits.state();
    locked.scanned.held = locked.before.held;
    return locked;
  }
};

TEST_F(FinishScanAgain, KeepsWhatIsLockedToTheBit) {
  auto [before, middle_mm, scanned] = lock_first_half();
  const FinishedScan after = finished(scanned);
  const auto locked = bits_in_ball(before.points, middle_mm, kLocked_mm);
  EXPECT_GT(locked.size(), 150U);
  EXPECT_TRUE(bits_in_ball(after.points, middle_mm, kLocked_mm) == locked);
  const auto inside = bits_in_ball(before.surface.mesh.vertices, middle_mm, kInside_mm);
  EXPECT_GT(inside.size(), 20U);
  EXPECT_TRUE(bits_in_ball(after.surface.mesh.vertices, middle_mm, kInside_mm) == inside);
  EXPECT_GT(after.points.size(), before.points.size()) << "the rest has the new views";
  // A third run holds the second.
  scanned.held = after.held;
  scanned.views.pop_back();
  EXPECT_TRUE(bits_in_ball(finished(scanned).points, middle_mm, kLocked_mm) == locked);
}

TEST_F(FinishScanAgain, WithoutALockNothingIsHeld) {
  const FinishedScan before = finished(first_half());
  ScannedViews scanned = whole();
  const FinishedScan alone = finished(scanned);
  scanned = whole();
  scanned.held = before.held;
  const FinishedScan after = finished(scanned);
  EXPECT_TRUE(bits_in_ball(after.points, Vec3f::Zero(), 1e3F) ==
              bits_in_ball(alone.points, Vec3f::Zero(), 1e3F));
}

TEST_F(FinishScanAgain, TheSurfaceHasNoStepAroundALock) {
  const Locked locked = lock_first_half();
  const FinishedScan after = finished(locked.scanned);
  // What was held comes from eight views with 30 µm of noise.
  const auto mean_off_mm = [&](float from_mm, float to_mm) {
    double sum = 0.0;
    int count = 0;
    for (const SurfacePoint& point : after.points) {
      const float distance_mm = (point.position_mm - locked.middle_mm).norm();
      if (distance_mm < from_mm || distance_mm > to_mm) continue;
      const Vec3 p_mm = point.position_mm.cast<double>();  // the first view lies as the scene
      sum += p_mm.z() - testing::cusped_height(p_mm.x(), p_mm.y());
      ++count;
    }
    return sum / count;
  };
  EXPECT_NEAR(mean_off_mm(kLocked_mm - 1.0F, kLocked_mm),
              mean_off_mm(kLocked_mm, kLocked_mm + 1.0F), 0.012);
}

TEST_F(FinishScan, ATextureFrameOfTheWrongKindCostsOnlyItself) {
  for (const cv::Mat& wrong : {cv::Mat(480, 640, CV_8UC1, cv::Scalar(9)),
                               cv::Mat(240, 320, CV_8UC3, cv::Scalar(9, 9, 9))}) {
    const auto finished = finish({}, wrong);
    ASSERT_TRUE(finished.has_value()) << finished.error().message;
    EXPECT_TRUE(finished->T_world_texture[0]);
    EXPECT_FALSE(finished->T_world_texture[1]);
    EXPECT_FALSE(finished->model.atlas.empty());
  }
}

}  // namespace
}  // namespace flytri::reconstruct
