#include "core/scan/background_refinement.h"

#include <gtest/gtest.h>

#include "tests/support/scan_scene.h"

namespace flytri::scan {
namespace {

using testing::scan_cusps;
using testing::SceneSensor;

/// Ten views, and a test in place of the scan's own thread.
class BackgroundRefinementOfTenViews : public ::testing::Test {
 protected:
  void run_and_wait() {
    refinement_.run_if_grown(views_.size(), [this] { return views_; });
    background_.wait_until_idle();
  }

  std::vector<AlignedView> views_ = scan_cusps(10, SceneSensor{}, 1).views;
  std::function<void()> answer_ = [] { FAIL() << "no run has ended"; };
  int taken_ = 0;
  TaskThread background_;
  BackgroundRefinement refinement_{
      {{}, 1.3, 2},
      background_,
      [this](std::function<void()> task) { answer_ = std::move(task); },
      [this](const auto&) { ++taken_; }};
};

TEST_F(BackgroundRefinementOfTenViews, HandsOverItsPoses) {
  run_and_wait();
  EXPECT_TRUE(refinement_.is_running());
  answer_();
  EXPECT_FALSE(refinement_.is_running());
  EXPECT_EQ(taken_, 1);
}

TEST_F(BackgroundRefinementOfTenViews, DoesNotReplaceBetterPosesThatCameMeanwhile) {
  run_and_wait();
  refinement_.discard_run();
  answer_();
  EXPECT_FALSE(refinement_.is_running());
  EXPECT_EQ(taken_, 0);
  views_.resize(14, views_.front());
  run_and_wait();
  answer_();
  EXPECT_EQ(taken_, 1);
}

}  // namespace
}  // namespace flytri::scan
