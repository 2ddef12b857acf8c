/// @file  The shape and color of one tooth in its own frame.
///
/// Tooth frame, mm: x towards the middle of the arch (mesial), y outwards (buccal), z towards the
/// opposing teeth (occlusal); origin in the middle of the neck. It is mirrored on the jaw's left.
#pragma once

#include <string>
#include <vector>

#include "core/geometry/rigid.h"

namespace flytri::sample_jaw {

/// A point of the rim around a chewing surface. Its position is in half widths; its height is in mm
/// below the crown's height.
struct RimPoint {
  Vec2 place;
  double drop_mm = 0.0;
  bool cusp = false;  ///< a cusp has a ridge towards the middle
};

/// Dimensions of a crown.
struct ToothForm {
  std::string name;
  double width_mm = 0.0;      ///< mesial to distal, at the contact points
  double depth_mm = 0.0;      ///< outer to inner face
  double height_mm = 0.0;     ///< neck to highest cusp
  double tilt_rad = 0.0;      ///< outward tilt of the crown
  std::vector<RimPoint> rim;  ///< around the chewing surface; empty for front teeth
  double point_mm = 0.0;      ///< front teeth: height of the edge's middle above its ends
};

/// One tooth as an implicit shape.
class Tooth {
 public:
  /// @param seed  of the small irregularities
  Tooth(ToothForm form, std::uint64_t seed);

  [[nodiscard]] const ToothForm& form() const { return form_; }
  /// Negative inside, mm. Continues as a root below the neck.
  [[nodiscard]] double operator()(const Vec3& p) const;
  /// The side walls of crown, neck and root without the top; the gum is modeled around them.
  [[nodiscard]] double wall(const Vec3& p) const;
  /// sRGB, 0..255.
  [[nodiscard]] Vec3 color(const Vec3& p) const;

 private:
  double molar_wall(const Vec3& p) const;
  double front_wall(const Vec3& p) const;
  double chewing_height(const Vec2& p) const;
  double edge_height(double x) const;
  double depth_mm(const Vec2& p, double height_mm) const;

  // A ridge of the chewing surface between two points.
  struct Ridge {
    Ridge(const Vec3& from, const Vec3& to);
    [[nodiscard]] double height(const Vec2& p) const;
    Vec2 start, along;
    double squared_length, height_mm, rise_mm;
  };

  ToothForm form_;
  std::vector<Ridge> ridges_;
  std::uint64_t seed_;
};

/// The seven teeth of one side from the middle outwards.
[[nodiscard]] std::vector<ToothForm> upper_teeth();
[[nodiscard]] std::vector<ToothForm> lower_teeth();

}  // namespace flytri::sample_jaw
