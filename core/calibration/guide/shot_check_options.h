/// @file  When a calibration image is refused.
#pragma once

#include <opencv2/core.hpp>

#include "core/base/result.h"
#include "core/calibration/guide/shot_verdict.h"
#include "core/localization/localize.h"

namespace flytri::calibration {

/// Limits for single images. Those of light are shares of full scale, so that they suit any camera.
struct ShotCheckOptions {
  localization::LocalizeOptions localize;
  /// 0..1, of full scale. Median height of lines or dots above the rest: below, an 8-bit camera
  /// has only twenty steps for them.
  double min_brightness = 0.08;
  /// 0..1. Largest share of clipped line samples or dots: clipped lines are left out of the fit.
  double max_saturated = 0.02;
  /// 0..0.5. Largest width of a line by the distance to the next: wider ones run into each other
  /// where a surface is steep, and the width no longer tells lines apart.
  double max_line_width = 0.15;
  /// 0..2. Largest width of a dot's edge by its diameter: beyond, its flanks meet in the middle.
  double max_edge_width = 0.5;
  /// 0..1. Least share of a line, and of the dots in sight, that must be there: a smear hides less.
  double min_complete = 0.9;
  /// 0..1, of full scale. Largest median of a dark image, the camera's black level included.
  double max_room_light = 0.25;
  /// 0..1, of full scale. A pixel so far above the median of a dark image is a reflection...
  double reflection_height = 0.25;
  /// 0..1. ... and so large a share of the image may be covered by them.
  double max_reflections = 0.001;
  /// 0..1, of full scale. By which the room may get brighter or darker after the dark image.
  double max_room_change = 0.05;
  /// > 0. By which lines may move while a plane rests: a thousandth of the distance between them.
  double max_shift_px = 0.1;
  [[nodiscard]] Result<void> validate() const;
};

/// The largest gray value that an image of this type can hold.
[[nodiscard]] double full_scale(const cv::Mat& image);

/// What a message calls the bright things of an image, and what of them is wide when out of focus.
struct ShotWords {
  std::string_view things, wide;
};

/// Whether they are neither clipped, nor out of focus, nor too dark.
/// @param widest_px  of what is in focus
[[nodiscard]] ShotVerdict judge_light(const ShotWords& words, const ShotFigures& figures,
                                      double widest_px, const ShotCheckOptions& options);

}  // namespace flytri::calibration
