/// @file  Assigns each spot in the image to its dot on the target.
#pragma once

#include <vector>

#include "core/base/result.h"
#include "core/calibration/fit/find_dots.h"
#include "core/calibration/record/calibration_set.h"

namespace flytri::calibration {

/// A dot and its position on the target: x = i * pitch, y = j * pitch.
struct NumberedDot {
  int i = 0;
  int j = 0;
  Pixel center;
};

/// Numbers the dots from the three large ones, (0, 0), (1, 0) and (0, 2), outwards over the grid.
/// The expected position of a dot follows from the grid steps at its neighbor. The result does not
/// contain the large dots: they are so close to each other that their blur overlaps.
/// @errors  kInconsistent if the three large dots are not found, or the grid is mirrored.
[[nodiscard]] Result<std::vector<NumberedDot>> number_dots(const std::vector<Dot>& dots,
                                                           const DotTarget& target);

}  // namespace flytri::calibration
