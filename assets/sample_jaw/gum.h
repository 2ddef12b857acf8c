/// @file  The gum around the teeth, with palate or floor, as one implicit shape.
#pragma once

#include <vector>

#include "assets/sample_jaw/dentition.h"

namespace flytri::sample_jaw {

/// Refers to the dentition, which must outlive it.
class Gum {
 public:
  explicit Gum(const Dentition& dentition);
  /// Negative inside, mm, jaw frame.
  [[nodiscard]] double operator()(const Vec3& p) const;
  /// sRGB, 0..255.
  [[nodiscard]] Vec3 color(const Vec3& p) const;
  /// True where the gum belongs to the model; beyond, an impression tray would have ended.
  [[nodiscard]] bool covers(const Vec3& p) const;

 private:
  // The neighboring teeth's necks and half depths, and where a place lies beside them.
  struct Station {
    double neck_mm = 0.0;
    double half_depth_mm = 0.0;
    ArchPlace place;
    double ridge_mm = 0.0;  // height of the gum without its collars around the teeth
  };
  Station compute_station(const Vec2& p) const;
  double ridge_height(const Vec2& p, const Station& here) const;
  // As computed on a grid beforehand, linear between its corners.
  Station station(const Vec2& p) const;
  double collar(const PlacedTooth& tooth, const Vec3& p) const;

  const Dentition& dentition_;
  std::vector<Station> grid_;
};

}  // namespace flytri::sample_jaw
