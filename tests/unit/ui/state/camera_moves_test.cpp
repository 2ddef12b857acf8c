#include "ui/state/camera_moves.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

namespace flytri::ui {
namespace {

const Eigen::AlignedBox3d kNoModel;
const Eigen::AlignedBox3d kJaw(Vec3(-20.0, 0.0, -8.0), Vec3(45.0, 60.0, 5.0));

/// A window in which a scan has just begun.
class CameraMoves : public ::testing::Test {
 protected:
  CameraMoves() {
    view_.scan = std::make_shared<scan::ScanSnapshot>();
    view_.volume_mm = Vec3(20.0, 15.0, 15.0);
    state_.picture = {1000, 700};
    move_automatically(view_, kNoModel, state_);
    first_ = state_.camera.destination();
  }
  /// Whether the camera looks at the sensor's volume as at the beginning.
  [[nodiscard]] bool looks_as_at_first() const {
    const CameraPose now = state_.camera.destination();
    return (now.target_mm - first_.target_mm).norm() < 1e-6 &&
           now.q_world_eye.angularDistance(first_.q_world_eye) < 1e-6 &&
           std::abs(now.height_mm - first_.height_mm) < 1e-6;
  }
  /// As after a look around a finished jaw.
  void look_around_a_jaw() {
    view_.stage = io::ScanStage::kUpper;
    move_automatically(view_, kJaw, state_);
    state_.follows_scan = false;
    state_.camera.fly_to({Vec3(3.0, 4.0, 5.0), Eigen::Quaterniond::Identity(), 12.0}, 0.0);
    move_automatically(view_, kJaw, state_);
  }

  AppView view_;
  CameraState state_;
  CameraPose first_;
};

TEST_F(CameraMoves, AnEmptyStageShowsTheMeasurementVolume) {
  look_around_a_jaw();
  ASSERT_FALSE(looks_as_at_first());
  view_.stage = io::ScanStage::kLower;
  move_automatically(view_, kNoModel, state_);
  EXPECT_TRUE(looks_as_at_first());
}

TEST_F(CameraMoves, AnEmptyCaseShowsTheMeasurementVolume) {
  look_around_a_jaw();
  move_automatically(view_, kNoModel, state_);
  EXPECT_TRUE(looks_as_at_first());
}

TEST_F(CameraMoves, AScannedStageIsShownAsAWhole) {
  look_around_a_jaw();
  view_.stage = io::ScanStage::kLower;
  move_automatically(view_, kNoModel, state_);
  move_automatically(view_, kJaw, state_);
  EXPECT_TRUE(kJaw.contains(state_.camera.destination().target_mm));
  EXPECT_GT(state_.camera.destination().height_mm, 60.0);
}

TEST_F(CameraMoves, ACameraMovedByTheUserStays) {
  look_around_a_jaw();
  const CameraPose chosen = state_.camera.destination();
  move_automatically(view_, kJaw, state_);
  EXPECT_EQ(state_.camera.destination().target_mm, chosen.target_mm);
  EXPECT_EQ(state_.camera.destination().height_mm, chosen.height_mm);
}

}  // namespace
}  // namespace flytri::ui
