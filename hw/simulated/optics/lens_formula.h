/// @file  The formula of the thin lens: 1 / focal = 1 / focus + 1 / image.
#pragma once

namespace flytri::simulated {

/// Distance from the lens to the chip or slide that is in focus at `focus_mm`.
/// @param focal_mm  0..focus_mm, focal length
[[nodiscard]] inline double image_distance_mm(double focal_mm, double focus_mm) {
  return focal_mm * focus_mm / (focus_mm - focal_mm);
}

/// Focal length of the lens with this distance to the chip or slide.
[[nodiscard]] inline double focal_length_mm(double image_mm, double focus_mm) {
  return image_mm * focus_mm / (image_mm + focus_mm);
}

}  // namespace flytri::simulated
