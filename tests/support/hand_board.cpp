#include "tests/support/hand_board.h"

#include "hw/simulated/datasets/simulate_board_set.h"

namespace flytri::testing {
namespace {

simulated::BoardSetOptions steady_hand() {
  simulated::BoardSetOptions options;
  options.tremor_mm = 0.002;
  return options;
}

}  // namespace

const calibration::BoardSet& hand_board() {
  static const calibration::BoardSet kSet =
      simulated::take_board_set(steady_hand(), Workers(2), {}).value();
  return kSet;
}

calibration::BoardPose one_board_pose() {
  static const calibration::BoardPose kPose = simulated::take_board_pose(steady_hand(), 1).value();
  calibration::BoardPose pose = kPose;
  for (cv::Mat* image : {&pose.dots.image, &pose.vertical.image, &pose.horizontal.image,
                         &pose.dots_texture.image, &pose.dots_after.image})
    *image = image->clone();
  return pose;
}

}  // namespace flytri::testing
