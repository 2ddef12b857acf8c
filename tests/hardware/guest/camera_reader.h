/// @file  Reads a camera like a capture loop and stores the frames.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <vector>

#include "hw/device/camera.h"

namespace flytri::testing {

/// A frame without its image.
struct ReadFrame {
  double time_s = 0.0;
  std::int64_t sequence = 0;
  bool damaged = false;
};

class CameraReader {
 public:
  CameraReader(const device::CameraMatch& match, const device::CameraSettings& settings);

  [[nodiscard]] device::Camera& camera() { return *camera_; }
  void start();

  /// Reads the given number of frames. Fails the test after `limit_s`.
  void read(int frames, double limit_s = 20.0);
  /// Reads until the status fulfills the condition. Fails the test after `limit_s`.
  void read_until(const std::function<bool(const device::CameraStatus&)>& wanted,
                  double limit_s = 20.0);

  [[nodiscard]] const std::vector<ReadFrame>& frames() const { return frames_; }
  [[nodiscard]] const cv::Mat& last_image() const { return last_image_; }
  /// Fails the test unless times and sequence numbers increase.
  void expect_order() const;

 private:
  void read_one();

  std::unique_ptr<device::Camera> camera_;
  std::vector<ReadFrame> frames_;
  cv::Mat last_image_;
};

}  // namespace flytri::testing
