/// @file  Measures in an image how much light is in vertical lines, in horizontal lines and in
/// areas.
///
/// The image is averaged over strips of rows, which keeps lines along columns and smooths
/// everything else; and over strips of columns for lines along rows. In a strip, structures
/// narrower than a line spacing count as lines, the rest as areas (top-hat by a morphological
/// opening). The triangulation angle is small, so lines stay nearly parallel to an image axis and
/// no calibration is needed.
/// @source  Serra, "Image Analysis and Mathematical Morphology", 1982 (top-hat).
#pragma once

#include <opencv2/core.hpp>

#include "core/base/result.h"

namespace flytri::sync {

struct ImageLightOptions {
  /// 4..64. Width of a strip: narrow enough that lines are straight in it, wide enough to average
  /// noise and speckle.
  int strip_px = 16;
  /// 0.01..0.2, share of the image's width or height: more than a line's width, less than a line
  /// spacing.
  double line_width_share = 0.04;
  /// > 1. Height of a line above the opening, in standard deviations of the noise. The opening
  /// itself is about two standard deviations too low.
  double threshold = 10.0;
  [[nodiscard]] Result<void> validate() const;
};

/// Light as a share of full scale, averaged over the image. All values are linear in light.
struct ImageLight {
  double along_columns = 0.0;  ///< light of narrow structures along columns
  double along_rows = 0.0;     ///< light of narrow structures along rows
  double area = 0.0;           ///< light of wide structures, above the darkest part of the image
  double darkest = 0.0;        ///< the darkest part of the image
  int line_places = 0;         ///< strip pixels on a line, both directions

  /// Share of the line light along columns, 0..1; 0.5 without lines.
  [[nodiscard]] double column_share() const {
    const double sum = along_columns + along_rows;
    return sum > 0.0 ? along_columns / sum : 0.5;
  }
};

/// @param image  CV_8UC1, CV_16UC1, or CV_8UC3, of which the green channel is used
[[nodiscard]] ImageLight measure_image_light(const cv::Mat& image,
                                             const ImageLightOptions& options = {});

}  // namespace flytri::sync
