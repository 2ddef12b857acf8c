/// @file  Tells from two images which light was switched between them.
#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "hw/device/light_switch.h"

namespace flytri::setup {

struct SeenLight {
  device::Light light = device::Light::kDark;
  bool went_off = false;  ///< it was on while the line was off
};

/// @param before, on, after  CV_16UC1, same size: while the line of a light was off, on, and off
///        again; so light of the room that gets brighter or darker does not count
/// @return  nothing: the images show no difference that is a pattern or a flash
[[nodiscard]] std::optional<SeenLight> seen_light(const cv::Mat& before, const cv::Mat& on,
                                                  const cv::Mat& after);

}  // namespace flytri::setup
