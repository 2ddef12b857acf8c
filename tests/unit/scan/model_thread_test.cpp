#include "core/scan/model_thread.h"

#include <gtest/gtest.h>

#include <future>

#include "tests/support/orthographic_calibration.h"
#include "tests/support/steered_scan.h"

namespace flytri::scan {
namespace {

AlignedView one_point(int frame) {
  auto view = std::make_shared<View>();
  view->frame = FrameIndex(static_cast<std::size_t>(frame));
  ProfilePoint point;
  point.deviation_mm = Vec3f(0, 0, 0.03F);
  view->profiles.push_back({LineIndex(0), Vec3::UnitX(), {point}});
  return {view, Isometry::Identity()};
}

TEST(ModelThread, ATaskThatChangesNothingPublishesWhatTheOneBeforeItChanged) {
  const calibration::Calibration calibration =
      testing::orthographic_calibration({20, 20, 20}, {640, 480}, 20.0);
  SnapshotBoard board;
  TaskThread background, at_rest;
  // Time stands still, so the second change is not due while another task waits.
  ModelThread model(*LiveModel::create({}, calibration, 0.5), {board,
                                                               background,
                                                               at_rest,
                                                               [] { return 100.0; },
                                                               [](const std::vector<double>&) {},
                                                               1000.0,
                                                               {},
                                                               calibration.volume.size_mm});
  model.add({one_point(0)}, {99.0});
  while (model.pending() > 0) std::this_thread::yield();
  ASSERT_EQ(board.snapshot()->latency.count, 1);

  std::promise<void> gate;
  model.when_done([opened = gate.get_future().share()] { opened.wait(); });
  model.add({one_point(1)}, {99.5});
  model.when_done([] {});
  gate.set_value();
  while (model.pending() > 0) std::this_thread::yield();
  EXPECT_EQ(board.snapshot()->latency.count, 2);
  EXPECT_EQ(board.snapshot()->model_offered_at_s, 99.5);
}

}  // namespace
}  // namespace flytri::scan
