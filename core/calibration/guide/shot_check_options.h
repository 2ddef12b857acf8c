/// @file  When a calibration image is rejected.
#pragma once

#include <opencv2/core.hpp>

#include "core/base/result.h"
#include "core/calibration/guide/shot_verdict.h"
#include "core/localization/localize.h"

namespace flytri::calibration {

/// Limits for single images. Brightness is a share of full scale, so that the limits work for any
/// camera.
struct ShotCheckOptions {
  localization::LocalizeOptions localize;
  /// 0..1, of full scale. Least median height of lines or dots above the background. At this value
  /// an 8-bit camera has only twenty gray steps for them.
  double min_brightness = 0.08;
  /// 0..1. Largest share of clipped line samples or dots: the fit ignores clipped samples.
  double max_saturated = 0.02;
  /// 0..0.5. Largest width of a line as a share of the line spacing. Wider lines merge on steep
  /// surfaces, and their width no longer distinguishes them.
  double max_line_width = 0.15;
  /// 0..2. Largest width of a dot's edge as a share of its diameter: above this, the edges meet in
  /// the center.
  double max_edge_width = 0.5;
  /// 0..1. Least share of a line, and of the dots in sight, that must be visible. A small smear is
  /// allowed.
  double min_complete = 0.9;
  /// 0..1, of full scale. Largest median of a dark image, including the camera's black level.
  double max_room_light = 0.25;
  /// 0..1, of full scale. A pixel this far above the median of a dark image is a reflection.
  double reflection_height = 0.25;
  /// 0..1. Largest share of the image with reflections.
  double max_reflections = 0.001;
  /// 0..1, of full scale. Largest change of the room light after the dark image.
  double max_room_change = 0.05;
  /// > 0. Largest motion of lines during the shots of a plane, px: about a thousandth of the line
  /// spacing.
  double max_shift_px = 0.1;
  [[nodiscard]] Result<void> validate() const;
};

/// The largest gray value that an image of this type can hold.
[[nodiscard]] double full_scale(const cv::Mat& image);

/// Words for messages: the bright things of an image, and what becomes wide when out of focus.
struct ShotWords {
  std::string_view things, wide;
};

/// Checks that they are not clipped, not out of focus and not too dark.
/// @param widest_px  largest width that is in focus
[[nodiscard]] ShotVerdict judge_light(const ShotWords& words, const ShotFigures& figures,
                                      double widest_px, const ShotCheckOptions& options);

}  // namespace flytri::calibration
