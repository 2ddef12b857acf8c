#include "core/scan/model_thread.h"

#include <gtest/gtest.h>

#include <future>

#include "tests/support/orthographic_calibration.h"
#include "tests/support/steered_scan.h"

namespace flytri::scan {
namespace {

AlignedView short_line(int frame, const Isometry& T_world_sensor = Isometry::Identity()) {
  auto view = std::make_shared<View>();
  view->frame = FrameIndex(static_cast<std::size_t>(frame));
  ProfilePoint point;
  point.position_mm.setZero();
  point.deviation_mm = Vec3f(0, 0, 0.03F);
  ProfilePoint next = point;
  next.position_mm.x() += 0.2;
  view->profiles.push_back({LineIndex(0), Vec3::UnitX(), {point, next}});
  return {view, T_world_sensor};
}

class ModelThreadTest : public ::testing::Test {
 protected:
  static live::LiveSurfaceOptions with_cells_of_1_mm() {
    live::LiveSurfaceOptions options;
    options.cell_mm = 1.0;
    return options;
  }
  void wait() {
    while (model.pending() > 0) std::this_thread::yield();
  }
  /// Lets the model's thread have `count` more tasks, one always waiting, and then calls `then`.
  void keep_busy(int count, std::function<void()> then) {
    model.when_done([this, count, then = std::move(then)] {
      if (count == 0) return then();
      keep_busy(count - 1, then);
    });
  }

  const calibration::Calibration calibration =
      testing::orthographic_calibration({20, 20, 20}, {640, 480}, 20.0);
  SnapshotBoard board;
  TaskThread background, at_rest;
  // Time stands still, so a change is not due while another task waits.
  ModelThread model{*LiveModel::create(with_cells_of_1_mm(), calibration, 0.5),
                    {board,
                     background,
                     at_rest,
                     [] { return 100.0; },
                     [](const std::vector<double>&) {},
                     1000.0,
                     {},
                     calibration.volume.size_mm}};
};

TEST_F(ModelThreadTest, ATaskThatChangesNothingPublishesWhatTheOneBeforeItChanged) {
  model.add({short_line(0)}, {99.0});
  wait();
  ASSERT_EQ(board.snapshot()->latency.count, 1);

  std::promise<void> gate;
  model.when_done([opened = gate.get_future().share()] { opened.wait(); });
  model.add({short_line(1)}, {99.5});
  model.when_done([] {});
  gate.set_value();
  wait();
  EXPECT_EQ(board.snapshot()->latency.count, 2);
  EXPECT_EQ(board.snapshot()->model_offered_at_s, 99.5);
}

TEST_F(ModelThreadTest, ARebuildGoesOnOnlyWhileNothingElseWaits) {
  const auto height_mm = [this] {
    const SurfelModel shown = board.snapshot()->model;
    return shown.empty() ? 0.0F : shown.front()->surfels.front().position_mm.z();
  };
  model.add({short_line(0), short_line(1)}, {98.0, 98.5});
  wait();
  ASSERT_EQ(height_mm(), 0.0F);

  const Isometry moved(Eigen::Translation3d(0.0, 0.0, 5.0));
  std::promise<float> height_while_busy_mm;
  keep_busy(0, [&] {
    model.follow({short_line(0, moved), short_line(1, moved)}, 0.0);
    keep_busy(50, [&] { height_while_busy_mm.set_value(height_mm()); });
  });
  EXPECT_EQ(height_while_busy_mm.get_future().get(), 0.0F);
  wait();
  EXPECT_EQ(height_mm(), 5.0F);
}

}  // namespace
}  // namespace flytri::scan
