#include "tests/support/hand_board.h"

#include "hw/simulated/datasets/simulate_board_set.h"

namespace flytri::testing {

const calibration::BoardSet& hand_board() {
  static const calibration::BoardSet kSet = [] {
    simulated::BoardSetOptions options;
    options.tremor_mm = 0.002;
    return simulated::take_board_set(options, Workers(2), {}).value();
  }();
  return kSet;
}

calibration::BoardPose hand_board_pose(std::size_t index) {
  calibration::BoardPose pose = hand_board().poses[index];
  for (cv::Mat* image : {&pose.dots.image, &pose.vertical.image, &pose.horizontal.image,
                         &pose.dots_texture.image, &pose.dots_after.image})
    *image = image->clone();
  return pose;
}

}  // namespace flytri::testing
