/// @file  The slide of a line projector as a sheet for the maker of a lithographic mask.
#pragma once

#include <vector>

#include "hw/sheets/sheet.h"
#include "hw/simulated/optics/sensor_model.h"

namespace flytri::sheets {

/// A slide at true scale, seen from the light source. Its origin is on the optical axis of the
/// lens.
struct Slide {
  double distance_mm = 0.0;            ///< to the lens
  std::vector<double> line_middle_mm;  ///< in x, by line: the image is upside down, so x falls
  double line_width_mm = 0.0;
  double line_length_mm = 0.0;
  Vec2 size_mm = Vec2::Zero();  ///< of the black part
};

/// The slide that makes the lines of a projector with this lens, by the formula of the thin lens.
/// @param focal_mm  focal length of the projector's lens
/// @errors  kBadOption: the lens has no image at the distance where the projector is in focus.
[[nodiscard]] Result<Slide> plan_slide(const simulated::ProjectorModel& projector, double focal_mm);

/// The middle of the slide at true scale is at `slide_mm` on the page.
struct SlideSheet {
  Sheet sheet;
  Slide slide;
  Vec2 slide_mm = Vec2::Zero();
};

/// The slide at true scale, an enlarged picture of it with the numbers of the lines, and their
/// places in millimeters.
/// @errors  As plan_slide and start_sheet.
[[nodiscard]] Result<SlideSheet> slide_sheet(const simulated::ProjectorModel& projector,
                                             double focal_mm);

}  // namespace flytri::sheets
