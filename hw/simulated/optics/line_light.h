/// @file  Computes the light of one line pattern on the chip of the measurement camera.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "hw/simulated/optics/slide_light.h"

namespace flytri::simulated {

/// Traces every pixel near a line. Immutable.
class LineLight {
 public:
  LineLight(const SensorModel& sensor, Pattern pattern);

  /// @return  CV_32FC1, share of full scale
  [[nodiscard]] cv::Mat image(const LineExposure& exposure) const;

 private:
  struct Spot;
  std::vector<int> pixels_near_lines(const LineExposure& exposure) const;
  void mark_around(const Vec3& p_sensor, cv::Mat& near) const;
  std::vector<Spot> trace_spots(const LineExposure& exposure, const std::vector<int>& pixels) const;
  void light_spot(const LineExposure& exposure, const RayHit& hit, Spot& spot) const;
  void cast_shadows(const LineExposure& exposure, std::vector<Spot>& spots) const;

  CameraModel camera_;
  SlideLight slide_;
  double reach_mm_ = 0.0;  // half the width of the lit strip around a line
};

}  // namespace flytri::simulated
