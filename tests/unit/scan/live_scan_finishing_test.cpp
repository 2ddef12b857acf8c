#include <gmock/gmock.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "core/scan/live_scan.h"
#include "tests/support/loop_scan.h"

namespace flytri::scan {
namespace {

using testing::finish;
using testing::kFramePeriod_s;
using testing::LoopScene;
using testing::make_scan;
using testing::measurement_frame;
using testing::offer;
using testing::options_for;
using testing::pose_rms_mm;
using testing::ScanNotes;
using testing::steady_s;

TEST(LiveScan, FinishesToAMeshAndContinues) {
  const auto scan = make_scan(options_for({}));
  scan->start();
  offer(*scan, 0, 90);
  const auto done = finish(*scan);
  EXPECT_EQ(done->phase, ScanPhase::kFinished);
  ASSERT_NE(done->result, nullptr) << done->failure;
  EXPECT_GT(done->result->surface.mesh.triangles.size(), 5000U);
  scan->start();
  offer(*scan, 90, 120);
  EXPECT_EQ(scan->snapshot()->phase, ScanPhase::kMeasurement);
  EXPECT_EQ(scan->snapshot()->result, nullptr);
}

TEST(LiveScan, KeepsTheScanIfFinishingIsCancelled) {
  const auto scan = make_scan(options_for({}));
  scan->start();
  offer(*scan, 0, 60);
  scan->finish();
  while (scan->snapshot()->phase == ScanPhase::kMeasurement) std::this_thread::yield();
  scan->cancel_finish();
  scan->wait_until_idle();
  // A fast machine may be done before the cancel arrives.
  if (scan->snapshot()->phase == ScanPhase::kFinished) GTEST_SKIP() << "finished before the cancel";
  EXPECT_EQ(scan->snapshot()->phase, ScanPhase::kPreview);
  EXPECT_EQ(scan->snapshot()->failure, "");
  EXPECT_FALSE(scan->snapshot()->model.empty());
}

TEST(LiveScan, TwoPressesOfFinishMakeOneRun) {
  const auto notes = std::make_shared<ScanNotes>();
  LiveScanOptions options = options_for({});
  options.journal = notes;
  const auto scan = make_scan(options);
  scan->start();
  offer(*scan, 0, 60);
  scan->finish();
  const auto done = finish(*scan);
  EXPECT_EQ(done->phase, ScanPhase::kFinished);
  EXPECT_EQ(notes->results, 1);
}

TEST(LiveScan, AFinishThatIsCancelledKeepsTheAlignment) {
  const auto notes = std::make_shared<ScanNotes>();
  LiveScanOptions options = options_for({});
  options.journal = notes;
  options.min_refine_views = 1000;  // only finishing optimizes
  const auto scan = make_scan(options);
  scan->start();
  offer(*scan, 0, 90);
  const double before_mm = pose_rms_mm(notes->placed_views());
  scan->finish();
  const auto stage = [&] { return scan->snapshot()->finishing.stage; };
  while (stage() != reconstruct::kSimplifying && stage() != reconstruct::kMeshing)
    std::this_thread::yield();
  scan->cancel_finish();
  scan->wait_until_idle();
  ASSERT_EQ(scan->snapshot()->phase, ScanPhase::kPreview);
  EXPECT_EQ(notes->results, 0);
  EXPECT_LT(pose_rms_mm(notes->placed_views()), 0.8 * before_mm);
}

/// Waits until the scan is in this phase; false after a minute.
bool reaches(const LiveScan& scan, ScanPhase phase) {
  for (int tries = 0; tries < 60'000 && scan.snapshot()->phase != phase; ++tries)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  return scan.snapshot()->phase == phase;
}

TEST(LiveScan, CommandsWhileFinishingDoNotDisturbIt) {
  LoopScene scene;
  scene.away_from_s = 30 * kFramePeriod_s;
  scene.away_to_s = 55 * kFramePeriod_s;
  const auto first = std::make_shared<ScanNotes>(), second = std::make_shared<ScanNotes>();
  LiveScanOptions options = options_for(scene);
  options.journal = first;
  const auto scan = make_scan(options);
  scan->start();
  offer(*scan, 0, 120);
  scan->finish();
  ASSERT_TRUE(reaches(*scan, ScanPhase::kFinishing));
  for (int i = 0; i < 20; ++i) {
    scan->pause();
    scan->start();
    scan->choose_reentry(0);
    scan->undo();
  }
  scan->keep_in(second);
  scan->wait_until_idle();
  const auto done = scan->snapshot();
  EXPECT_EQ(done->phase, ScanPhase::kFinished);
  ASSERT_NE(done->result, nullptr) << done->failure;
  EXPECT_EQ(second->results, 1);
  EXPECT_GE(second->poses.size(), done->result->views.size());
  EXPECT_TRUE(second->has_each_placed_view_once());
}

/// A scan of 90 frames, paused. Without optimizations in the background, each is the same.
std::unique_ptr<LiveScan> paused_scan(LiveScanOptions options) {
  options.min_refine_views = 1000;
  auto scan = make_scan(options);
  scan->start();
  offer(*scan, 0, 90);
  scan->pause();
  scan->wait_until_idle();
  return scan;
}

std::vector<float> coordinates_of(const reconstruct::FinishedScan& finished) {
  std::vector<float> coordinates;
  for (const SurfacePoint& vertex : finished.surface.mesh.vertices) {
    coordinates.insert(coordinates.end(), vertex.position_mm.begin(), vertex.position_mm.end());
  }
  return coordinates;
}

Surfel middle_of(const LiveScan& scan) {
  const auto now = scan.snapshot();
  return now->model[now->model.size() / 2]->surfels.front();
}

void cut_hole(LiveScan& scan, const Surfel& at, float radius_mm) {
  scan.edit(editing::EditKind::kTrim, {{at.position_mm, at.normal, radius_mm}});
}

TEST(LiveScan, APausedScanIsFinishedAheadWithTheSameModel) {
  std::atomic<int> asked_time{0};
  LiveScanOptions options = options_for({});
  options.now_s = [&asked_time] {
    ++asked_time;
    return steady_s();
  };
  const auto scan = paused_scan(options);
  scan->finish_ahead();
  scan->wait_until_idle();
  EXPECT_EQ(scan->snapshot()->phase, ScanPhase::kPreview);
  EXPECT_EQ(scan->snapshot()->result, nullptr);
  // Each stage of a run asks for the time.
  const int before = asked_time;
  const auto done = finish(*scan);
  EXPECT_EQ(asked_time, before);
  ASSERT_NE(done->result, nullptr) << done->failure;

  const auto other = finish(*paused_scan(options_for({})));
  ASSERT_NE(other->result, nullptr) << other->failure;
  EXPECT_TRUE(coordinates_of(*done->result) == coordinates_of(*other->result));
}

TEST(LiveScan, FinishTakesOverARunAheadThatIsNotDone) {
  const auto notes = std::make_shared<ScanNotes>();
  LiveScanOptions options = options_for({});
  options.journal = notes;
  const auto scan = paused_scan(options);
  scan->finish_ahead();
  const auto done = finish(*scan);
  EXPECT_EQ(done->phase, ScanPhase::kFinished);
  ASSERT_NE(done->result, nullptr) << done->failure;
  EXPECT_EQ(notes->results, 1);
}

TEST(LiveScan, ARunAheadGivesWayToTheScan) {
  const auto scan = paused_scan(options_for({}));
  scan->finish_ahead();
  scan->start();
  offer(*scan, 90, 130);
  EXPECT_EQ(scan->snapshot()->phase, ScanPhase::kMeasurement);
  EXPECT_EQ(scan->snapshot()->result, nullptr);
  EXPECT_GE(scan->snapshot()->view_count(), 120);
  // The next pause begins another one, with the new views.
  scan->pause();
  scan->wait_until_idle();
  const auto done = finish(*scan);
  ASSERT_NE(done->result, nullptr) << done->failure;
  EXPECT_GE(done->result->views.size(), 120U);
}

TEST(LiveScan, AScanGoesOnWithThePosesOfARunAhead) {
  const auto notes = std::make_shared<ScanNotes>();
  LiveScanOptions options = options_for({});
  options.journal = notes;
  const auto scan = paused_scan(options);
  const double before_mm = pose_rms_mm(notes->placed_views());
  scan->finish_ahead();
  scan->wait_until_idle();
  scan->start();
  scan->wait_until_idle();
  EXPECT_EQ(scan->snapshot()->phase, ScanPhase::kContinuation);
  EXPECT_LT(pose_rms_mm(notes->placed_views()), 0.8 * before_mm);
}

TEST(LiveScan, ARunAheadFollowsAnEdit) {
  const auto edited = [](bool is_ahead) {
    const auto scan = paused_scan(options_for({}));
    const Surfel middle = middle_of(*scan);
    if (is_ahead) {
      scan->finish_ahead();
      scan->wait_until_idle();
    } else {
      finish(*scan);
    }
    cut_hole(*scan, middle, 3.0F);
    if (is_ahead) scan->wait_until_idle();
    return finish(*scan);
  };
  const auto ahead = edited(true), plain = edited(false);
  ASSERT_NE(ahead->result, nullptr) << ahead->failure;
  ASSERT_NE(plain->result, nullptr) << plain->failure;
  EXPECT_TRUE(coordinates_of(*ahead->result) == coordinates_of(*plain->result));
}

TEST(LiveScan, FinishThatClosesOtherHolesDoesNotUseTheRunAhead) {
  const auto scan = paused_scan(options_for({}));
  cut_hole(*scan, middle_of(*scan), 2.0F);
  scan->finish_ahead(0.0);
  scan->wait_until_idle();
  scan->finish(10.0);
  scan->wait_until_idle();
  const auto done = scan->snapshot();
  ASSERT_NE(done->result, nullptr) << done->failure;
  EXPECT_GE(done->result->surface.closed_holes, 1U);
}

TEST(LiveScan, AFinishThatBeganAheadCanBeCancelled) {
  const auto scan = paused_scan(options_for({}));
  scan->finish_ahead();
  scan->finish();
  while (scan->snapshot()->phase == ScanPhase::kPreview) std::this_thread::yield();
  scan->cancel_finish();
  scan->wait_until_idle();
  if (scan->snapshot()->phase == ScanPhase::kFinished) GTEST_SKIP() << "finished before the cancel";
  EXPECT_EQ(scan->snapshot()->phase, ScanPhase::kPreview);
  EXPECT_EQ(scan->snapshot()->failure, "");
  EXPECT_NE(finish(*scan)->result, nullptr);
}

TEST(LiveScan, IsFinishedAheadOnceTheSensorHasBeenAwayForSomeSeconds) {
  LoopScene scene;
  scene.away_from_s = 90 * kFramePeriod_s;
  scene.away_to_s = 180 * kFramePeriod_s;
  const auto notes = std::make_shared<ScanNotes>();
  LiveScanOptions options = options_for(scene);
  options.journal = notes;
  options.min_refine_views = 1000;  // only finishing optimizes
  const auto scan = make_scan(options);
  scan->start();
  scan->finish_ahead();
  offer(*scan, 0, 90);
  const double before_mm = pose_rms_mm(notes->placed_views());
  offer(*scan, 90, 120);
  EXPECT_EQ(scan->snapshot()->phase, ScanPhase::kContinuation);
  EXPECT_EQ(pose_rms_mm(notes->placed_views()), before_mm);
  offer(*scan, 120, 160);
  EXPECT_EQ(scan->snapshot()->phase, ScanPhase::kContinuation);
  EXPECT_LT(pose_rms_mm(notes->placed_views()), 0.8 * before_mm);
  // The user may still come back.
  offer(*scan, 160, 220);
  EXPECT_EQ(scan->snapshot()->phase, ScanPhase::kMeasurement);
  EXPECT_GE(scan->snapshot()->counts.registered, 120);
  EXPECT_NE(finish(*scan)->result, nullptr);
}

TEST(LiveScan, ASensorThatRestedIsNotAwayAtOnceWhenTheScanGoesOn) {
  LoopScene scene;
  scene.away_from_s = 90 * kFramePeriod_s;
  const auto notes = std::make_shared<ScanNotes>();
  LiveScanOptions options = options_for(scene);
  options.journal = notes;
  const auto scan = paused_scan(options);
  const double before_mm = pose_rms_mm(notes->placed_views());
  scan->start();
  scan->finish_ahead();
  offer(*scan, 400, 430);
  EXPECT_EQ(scan->snapshot()->phase, ScanPhase::kContinuation);
  EXPECT_EQ(pose_rms_mm(notes->placed_views()), before_mm);
  offer(*scan, 430, 470);
  EXPECT_LT(pose_rms_mm(notes->placed_views()), 0.8 * before_mm);
}

TEST(LiveScan, CommandsDuringARunAheadAreCarriedOut) {
  LoopScene scene;
  scene.away_from_s = 90 * kFramePeriod_s;
  const auto scan = make_scan(options_for(scene));
  scan->start();
  scan->finish_ahead();
  offer(*scan, 0, 100);
  for (int i = 100; i < 160; ++i) scan->offer(measurement_frame(i));
  scan->choose_reentry(0);
  cut_hole(*scan, middle_of(*scan), 1.0F);
  scan->keep_in(std::make_shared<ScanNotes>());
  scan->pause();
  scan->wait_until_idle();
  EXPECT_EQ(scan->snapshot()->phase, ScanPhase::kPreview);
  EXPECT_TRUE(scan->snapshot()->can_undo);
  EXPECT_NE(finish(*scan)->result, nullptr);
}

TEST(LiveScan, EndsWhileARunAheadIsAtWork) {
  const auto scan = paused_scan(options_for({}));
  scan->finish_ahead();
}

}  // namespace
}  // namespace flytri::scan
