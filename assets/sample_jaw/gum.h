/// @file  The gum around the teeth, with the palate or the floor of the mouth, as an implicit
/// shape.
#pragma once

#include <vector>

#include "assets/sample_jaw/dentition.h"

namespace flytri::sample_jaw {

/// Keeps a reference to the dentition, which must outlive it.
class Gum {
 public:
  explicit Gum(const Dentition& dentition);
  /// Negative inside, mm, jaw frame.
  [[nodiscard]] double operator()(const Vec3& p) const;
  /// sRGB, 0..255.
  [[nodiscard]] Vec3 color(const Vec3& p) const;
  /// Whether the gum at this place belongs to the model; the model ends like an impression tray.
  [[nodiscard]] bool covers(const Vec3& p) const;

 private:
  // Neck height and half depth of the neighboring teeth, and the position beside them.
  struct Station {
    double neck_mm = 0.0;
    double half_depth_mm = 0.0;
    ArchPlace place;
    double ridge_mm = 0.0;  // gum height without the collars around the teeth
  };
  Station compute_station(const Vec2& p) const;
  double ridge_height(const Vec2& p, const Station& here) const;
  // Interpolated linearly on a precomputed grid.
  Station station(const Vec2& p) const;
  double collar(const PlacedTooth& tooth, const Vec3& p) const;

  const Dentition& dentition_;
  std::vector<Station> grid_;
};

}  // namespace flytri::sample_jaw
