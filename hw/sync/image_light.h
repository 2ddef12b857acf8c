/// @file  From one image to how much light runs along columns, along rows, and over whole areas.
///
/// The image is averaged along strips of rows, which keeps what runs along columns and smooths all
/// else away, and likewise the other way round. What is narrower than a line spacing in such a
/// strip belongs to a line, the rest to an area: a top-hat by a morphological opening. Lines keep
/// close to their image axis because the triangulation angle is small, so no calibration is needed.
/// @source  Serra, "Image Analysis and Mathematical Morphology", 1982 (top-hat).
#pragma once

#include <opencv2/core.hpp>

#include "core/base/result.h"

namespace flytri::sync {

struct ImageLightOptions {
  /// 4..64. Strips over which is averaged: lines lean little over them, noise and speckle average
  /// out.
  int strip_px = 16;
  /// 0.01..0.2, of the image's width or height: wider than a line, narrower than a line spacing.
  double line_width_share = 0.04;
  /// > 1. What stands this many standard deviations of a strip's noise above its opening is a
  /// line: the opening itself lies some two of them too low.
  double threshold = 10.0;
  [[nodiscard]] Result<void> validate() const;
};

/// Light by full scale of the image, averaged over it: all sums are linear in light.
struct ImageLight {
  double along_columns = 0.0;  ///< of narrow structures that run along columns
  double along_rows = 0.0;     ///< of those along rows
  double area = 0.0;           ///< of wide structures above the darkest part of the image
  int line_places = 0;         ///< places of strips where a line was seen, of both directions

  /// Of the lines' light, what runs along columns, 0..1; 0.5 where there are none.
  [[nodiscard]] double column_share() const {
    const double sum = along_columns + along_rows;
    return sum > 0.0 ? along_columns / sum : 0.5;
  }
};

/// @param image  CV_8UC1 or CV_16UC1, or CV_8UC3 of which the green is taken
[[nodiscard]] ImageLight measure_image_light(const cv::Mat& image,
                                             const ImageLightOptions& options = {});

}  // namespace flytri::sync
