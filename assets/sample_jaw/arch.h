/// @file  The curve of the dental arch, with conversion to and from coordinates along it.
#pragma once

#include <vector>

#include "core/geometry/rigid.h"

namespace flytri::sample_jaw {

/// Coordinates along and beside the arch, mm.
struct ArchPlace {
  double along_mm = 0.0;    ///< from the middle; increases with x
  double outward_mm = 0.0;  ///< from the curve, away from the tongue
};

/// Half an ellipse, open towards -y, extended by straight ends.
class Arch {
 public:
  /// @param half_width_mm, depth_mm  > 0, half axes along x and y
  Arch(double half_width_mm, double depth_mm);

  [[nodiscard]] Vec2 point(double along_mm) const;
  /// Unit vector in the direction of increasing `along_mm`.
  [[nodiscard]] Vec2 tangent(double along_mm) const;
  [[nodiscard]] Vec2 outward(double along_mm) const;
  /// Coordinates relative to the nearest point of the curve, accurate to about 0.01 mm.
  [[nodiscard]] ArchPlace locate(const Vec2& p) const;

 private:
  double along_of(std::size_t sample) const;

  std::vector<Vec2> samples_;  // every kStep_mm along the curve
};

}  // namespace flytri::sample_jaw
