#include "core/scan/live_scan.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <future>
#include <mutex>
#include <thread>

#include "core/base/median.h"
#include "tests/support/loop_scan.h"
#include "tests/support/wavy_scene.h"

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
using testing::SceneSensor;
using testing::steady_s;

/// From a frame on, vertical lines are measured too far away: their projector has moved.
/// @return  the frame after which that was reported; 0: it was not
int frame_of_report(double shift_mm, int moved_at) {
  constexpr int kFrames = 360, kStep = 30;
  const LoopScene scene;
  const auto scan = make_scan(testing::steered_options([=](const Frame& frame) {
    auto measured = scene.measure(frame);
    if (frame.index.value < moved_at || frame.kind != FrameKind::kVertical) return measured;
    for (Profile& profile : measured->view.profiles) {
      for (ProfilePoint& point : profile.points) point.position_mm.z() += shift_mm;
    }
    return measured;
  }));
  scan->start();
  for (int i = 0; i < kFrames; i += kStep) {
    offer(*scan, i, i + kStep);
    const auto now = scan->snapshot();
    if (!now->moved_projector) continue;
    EXPECT_NEAR(now->moved_projector->shift_mm.z(), shift_mm, 0.3 * shift_mm);
    return i + kStep;
  }
  return 0;
}

TEST(LiveScan, AProjectorThatHasMovedIsReported) {
  EXPECT_EQ(frame_of_report(0.0, 0), 0);
  constexpr int kMovedAt = 90;
  const int reported = frame_of_report(0.15, kMovedAt);
  EXPECT_GT(reported, kMovedAt);
  EXPECT_LT(reported, kMovedAt + 200);
}

TEST(LiveScan, ShowsAndHidesWhatHasGone) {
  const auto scan = make_scan(options_for({}));
  scan->start();
  offer(*scan, 0, 30);
  EXPECT_FALSE(scan->snapshot()->shows_crossed);
  scan->show_crossed(true);
  scan->wait_until_idle();
  EXPECT_TRUE(scan->snapshot()->shows_crossed);
  scan->show_crossed(false);
  scan->wait_until_idle();
  EXPECT_FALSE(scan->snapshot()->shows_crossed);
}

TEST(LiveScan, BeforeTheStartItMeasuresButSavesNothing) {
  const auto scan = make_scan(options_for({}));
  offer(*scan, 0, 6);
  const auto now = scan->snapshot();
  EXPECT_EQ(now->phase, ScanPhase::kPreview);
  EXPECT_EQ(now->counts.previewed, 6);
  EXPECT_TRUE(now->model.empty());
  ASSERT_NE(now->latest[0], nullptr);
  ASSERT_NE(now->latest[1], nullptr);
  EXPECT_EQ(now->latest[1]->frame.index, FrameIndex(5));
  ASSERT_TRUE(now->distance);
  EXPECT_LT(std::abs(now->distance->depth_share), 0.5);
}

TEST(LiveScan, AScanGrowsAndCountsEachFrameOnce) {
  const auto scan = make_scan(options_for({}));
  scan->start();
  offer(*scan, 0, 90);
  const auto now = scan->snapshot();
  EXPECT_EQ(now->phase, ScanPhase::kMeasurement);
  EXPECT_EQ(now->counts.offered, 90);
  EXPECT_EQ(now->counts.registered, 90);
  EXPECT_EQ(now->counts.pending, 0);
  EXPECT_GT(surfel_count(now->model), 5000U);
  // The sensor sees about 20 x 15 mm; its movement and the slopes of the waves add to that.
  EXPECT_GT(now->area_mm2, 300.0);
  EXPECT_LT(now->area_mm2, 900.0);
  EXPECT_GT(now->good_share, 0.5);
  // Views that are published together count one by one, and the last views are published, too.
  EXPECT_EQ(now->latency.count, 90);
}

TEST(LiveScan, ShowsTheLastViewsAfterTheModelWasBusy) {
  LiveScanOptions options = options_for({});
  std::promise<void> gate;
  // Stops the model's thread where it asks for the time before it publishes.
  options.now_s = [opened = gate.get_future().share(), test = std::this_thread::get_id()] {
    if (std::this_thread::get_id() != test) opened.wait();
    return steady_s();
  };
  const auto scan = make_scan(options);
  scan->start();
  for (int i = 0; i < 30; ++i) scan->offer(measurement_frame(i));
  const double end_s = steady_s() + 60.0;
  while (scan->snapshot()->counts.registered < 30 && steady_s() < end_s) std::this_thread::yield();
  gate.set_value();
  scan->wait_until_idle();
  EXPECT_EQ(scan->snapshot()->counts.registered, 30);
  EXPECT_EQ(scan->snapshot()->latency.count, 30);
}

TEST(LiveScan, SurfelsLieOnTheSurfaceWithItsNormals) {
  const auto scan = make_scan(options_for({}));
  scan->start();
  offer(*scan, 0, 90);
  const Isometry T_scene_world = testing::loop_pose(0.0);
  double sum2 = 0.0;
  std::vector<double> cosines;
  for (const auto& block : scan->snapshot()->model) {
    for (const Surfel& surfel : block->surfels) {
      const Vec3 p = T_scene_world * surfel.position_mm.cast<double>();
      constexpr double kStep_mm = 0.01;
      const auto height = testing::cusped_height;
      const Vec3 normal =
          Vec3((height(p.x() + kStep_mm, p.y()) - height(p.x() - kStep_mm, p.y())),
               (height(p.x(), p.y() + kStep_mm) - height(p.x(), p.y() - kStep_mm)), -2.0 * kStep_mm)
              .normalized();
      const double off_mm = (p.z() - height(p.x(), p.y())) * normal.z();
      sum2 += off_mm * off_mm;
      cosines.push_back(normal.dot(T_scene_world.linear() * surfel.normal.cast<double>()));
    }
  }
  // Points have 30 µm of noise; a cell averages several points.
  EXPECT_LT(std::sqrt(sum2 / static_cast<double>(cosines.size())), 0.03);
  // Inside the cube of a normal, the waves turn by up to 20 degrees.
  EXPECT_GT(median_of(cosines), 0.98);
}

TEST(LiveScan, ContinuesByItselfAfterTheSensorWasAway) {
  LoopScene scene;
  scene.away_from_s = 60 * kFramePeriod_s;
  scene.away_to_s = 90 * kFramePeriod_s;
  const auto scan = make_scan(options_for(scene));
  scan->start();
  offer(*scan, 0, 90);
  const auto lost = scan->snapshot();
  EXPECT_EQ(lost->phase, ScanPhase::kContinuation);
  ASSERT_FALSE(lost->reentry.empty());
  EXPECT_NE(lost->reentry.front().image, nullptr);
  EXPECT_EQ(lost->match_share, 0.0);
  EXPECT_EQ(lost->counts.rejected.at("too few points inside the measurement volume"), 30);
  offer(*scan, 90, 150);
  const auto back = scan->snapshot();
  EXPECT_EQ(back->phase, ScanPhase::kMeasurement);
  EXPECT_TRUE(back->reentry.empty());
  EXPECT_GE(back->counts.registered, 110);
  EXPECT_EQ(back->counts.pending, 0);
}

TEST(LiveScan, AnInterruptedScanIsAsAccurateAsAnother) {
  LoopScene whole, interrupted;
  interrupted.away_from_s = 60 * kFramePeriod_s;
  interrupted.away_to_s = 90 * kFramePeriod_s;
  double rms_mm[2];
  for (const int i : {0, 1}) {
    const auto scan = make_scan(options_for(i == 0 ? whole : interrupted));
    scan->start();
    offer(*scan, 0, 180);
    const auto done = finish(*scan);
    ASSERT_NE(done->result, nullptr) << done->failure;
    rms_mm[i] = pose_rms_mm(done->result->views);
  }
  // A sixth of the views is missing. More than twice the error would mean a wrong pose.
  EXPECT_LT(rms_mm[1], 2.0 * rms_mm[0]);
  EXPECT_LT(rms_mm[0], 0.03);
}

TEST(LiveScan, ContinuesThePausedModel) {
  const auto scan = make_scan(options_for({}));
  scan->start();
  offer(*scan, 0, 60);
  scan->pause();
  offer(*scan, 60, 80);
  EXPECT_EQ(scan->snapshot()->phase, ScanPhase::kPreview);
  EXPECT_EQ(scan->snapshot()->counts.previewed, 20);
  const std::size_t before = surfel_count(scan->snapshot()->model);
  scan->start();
  offer(*scan, 80, 120);
  EXPECT_EQ(scan->snapshot()->phase, ScanPhase::kMeasurement);
  EXPECT_GE(surfel_count(scan->snapshot()->model), before);
}

TEST(LiveScan, UndoBringsBackTrimmedPlaces) {
  const auto scan = make_scan(options_for({}));
  scan->start();
  offer(*scan, 0, 60);
  scan->pause();
  scan->wait_until_idle();
  const auto full = scan->snapshot();
  const Surfel middle = full->model[full->model.size() / 2]->surfels.front();
  scan->edit(editing::EditKind::kTrim, {{middle.position_mm, middle.normal, 3.0F}});
  scan->wait_until_idle();
  const auto trimmed = scan->snapshot();
  EXPECT_TRUE(trimmed->can_undo);
  EXPECT_LT(surfel_count(trimmed->model), surfel_count(full->model) - 100);
  scan->undo();
  scan->wait_until_idle();
  EXPECT_EQ(surfel_count(scan->snapshot()->model), surfel_count(full->model));
  EXPECT_TRUE(scan->snapshot()->can_redo);
}

/// Places of all surfels, sorted.
std::vector<std::array<float, 3>> places_of(const SurfelModel& model) {
  std::vector<std::array<float, 3>> places;
  for (const auto& block : model) {
    for (const Surfel& surfel : block->surfels) {
      const Vec3f& p_mm = surfel.position_mm;
      places.push_back({p_mm.x(), p_mm.y(), p_mm.z()});
    }
  }
  std::sort(places.begin(), places.end());
  return places;
}

TEST(LiveScan, RedoOfTwoTrimsRemovesWhatTheyHadRemoved) {
  const auto scan = make_scan(options_for({}));
  scan->start();
  offer(*scan, 0, 60);
  scan->pause();
  scan->wait_until_idle();
  const auto full = scan->snapshot();
  const Surfel middle = full->model[full->model.size() / 2]->surfels.front();
  for (const float x_mm : {0.0F, 2.5F}) {
    const Vec3f center_mm = middle.position_mm + Vec3f(x_mm, 0, 0);
    scan->edit(editing::EditKind::kTrim, {{center_mm, middle.normal, 2.0F}});
    scan->wait_until_idle();
  }
  const auto trimmed = places_of(scan->snapshot()->model);
  ASSERT_LT(trimmed.size(), surfel_count(full->model) - 100);
  for (const auto change : {&LiveScan::undo, &LiveScan::undo, &LiveScan::redo, &LiveScan::redo}) {
    (*scan.*change)();
    scan->wait_until_idle();
  }
  const auto again = places_of(scan->snapshot()->model);
  EXPECT_TRUE(again == trimmed) << again.size() << " places where " << trimmed.size() << " were";
}

/// Waits for the search for holes, which runs in the background.
bool knows_holes_soon(const LiveScan& scan) {
  for (int tries = 0; tries < 3000 && !scan.snapshot()->holes_are_current; ++tries)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  return scan.snapshot()->holes_are_current;
}

TEST(LiveScan, HolesOfAPausedScanFollowItsEdits) {
  const auto scan = make_scan(options_for({}));
  scan->start();
  offer(*scan, 0, 60);
  scan->pause();
  scan->wait_until_idle();
  ASSERT_TRUE(knows_holes_soon(*scan));
  const std::size_t before = scan->snapshot()->holes.size();
  const auto full = scan->snapshot();
  const Surfel middle = full->model[full->model.size() / 2]->surfels.front();
  // The second edit comes during the search after the first.
  for (const float radius_mm : {1.0F, 3.0F}) {
    scan->edit(editing::EditKind::kTrim, {{middle.position_mm, middle.normal, radius_mm}});
    scan->wait_until_idle();
  }
  ASSERT_TRUE(knows_holes_soon(*scan));
  EXPECT_GT(scan->snapshot()->holes.size(), before);
  scan->undo();
  scan->undo();
  scan->wait_until_idle();
  ASSERT_TRUE(knows_holes_soon(*scan));
  EXPECT_EQ(scan->snapshot()->holes.size(), before);
}

TEST(LiveScan, HolesOfAFinishedScanFollowItsEdits) {
  const auto scan = make_scan(options_for({}));
  scan->start();
  offer(*scan, 0, 60);
  const auto done = finish(*scan);
  ASSERT_NE(done->result, nullptr) << done->failure;
  EXPECT_TRUE(done->holes_are_current);
  const Surfel middle = done->model[done->model.size() / 2]->surfels.front();
  scan->edit(editing::EditKind::kTrim, {{middle.position_mm, middle.normal, 3.0F}});
  scan->wait_until_idle();
  ASSERT_TRUE(knows_holes_soon(*scan));
  EXPECT_GT(scan->snapshot()->holes.size(), done->holes.size());
}

TEST(LiveScan, UndoAndRedoOfAFinishedScanLeadBackToTheEditedSurface) {
  const auto scan = make_scan(options_for({}));
  scan->start();
  offer(*scan, 0, 60);
  scan->pause();
  scan->wait_until_idle();
  const auto full = scan->snapshot();
  const Surfel middle = full->model[full->model.size() / 2]->surfels.front();
  scan->edit(editing::EditKind::kTrim, {{middle.position_mm, middle.normal, 3.0F}});
  const auto trimmed = finish(*scan);
  ASSERT_NE(trimmed->result, nullptr) << trimmed->failure;
  scan->undo();
  scan->wait_until_idle();
  const auto undone = scan->snapshot();
  // The mesh is that of the trimmed scan: it is not shown any more, and Finish makes another.
  EXPECT_EQ(undone->phase, ScanPhase::kPreview);
  EXPECT_EQ(undone->result, nullptr);
  EXPECT_GT(surfel_count(undone->model), surfel_count(trimmed->model) + 100);
  const auto with_all = finish(*scan);
  ASSERT_NE(with_all->result, nullptr) << with_all->failure;
  const auto vertex_near = [&](const reconstruct::FinishedScan& result) {
    const auto& points = result.points;
    return std::any_of(points.begin(), points.end(), [&](const SurfacePoint& point) {
      return (point.position_mm - middle.position_mm).norm() < 1.5F;
    });
  };
  EXPECT_FALSE(vertex_near(*trimmed->result));
  EXPECT_TRUE(vertex_near(*with_all->result));
  scan->redo();
  scan->wait_until_idle();
  EXPECT_EQ(scan->snapshot()->result, nullptr);
  // Finishing twice gives slightly different poses, which move a few points to other cells.
  EXPECT_NEAR(static_cast<double>(surfel_count(scan->snapshot()->model)),
              static_cast<double>(surfel_count(trimmed->model)), 50.0);
}

TEST(LiveScan, HighLoadCostsViewsButNoDelay) {
  LoopScene scene;
  LiveScanOptions options = options_for(scene);
  options.max_frames_underway = 4;
  options.measure_frame = [scene](const Frame& frame) {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    return scene.measure(frame);
  };
  const auto scan = make_scan(options);
  scan->start();
  offer(*scan, 0, 300);  // at once
  const FrameCounts counts = scan->snapshot()->counts;
  EXPECT_GT(counts.skipped, 100);
  EXPECT_EQ(counts.offered, 300);
  EXPECT_EQ(counts.pending, 0);
}

TEST(LiveScan, AScanCanBeContinuedFromItsJournal) {
  const auto notes = std::make_shared<ScanNotes>();
  LiveScanOptions options = options_for({});
  options.journal = notes;
  {
    const auto scan = make_scan(options);
    scan->start();
    offer(*scan, 0, 90);
  }
  EXPECT_EQ(notes->views.size(), 90U);
  EXPECT_EQ(notes->poses.size(), 90U);
  EXPECT_GT(notes->commits, 0);
  KeptScan kept;
  kept.views = notes->placed_views();
  const auto scan = make_scan(options_for({}), kept);
  scan->wait_until_idle();
  EXPECT_GT(surfel_count(scan->snapshot()->model), 5000U);
  EXPECT_EQ(scan->snapshot()->view_count(), 90);
  EXPECT_NEAR(scan->snapshot()->scanned_s, 89.0 / 30.0, 1e-6);
  scan->start();
  offer(*scan, 95, 130);
  EXPECT_EQ(scan->snapshot()->phase, ScanPhase::kMeasurement);
  EXPECT_GE(scan->snapshot()->counts.registered, 25);
  EXPECT_GE(scan->snapshot()->view_count(), 115);
}

TEST(LiveScan, NamesTheOptionThatIsWrong) {
  LiveScanOptions options;
  const auto scan = LiveScan::create(std::make_shared<calibration::Calibration>(), options);
  ASSERT_FALSE(scan);
  EXPECT_THAT(scan.error().message, ::testing::HasSubstr("now_s"));
}

}  // namespace
}  // namespace flytri::scan
