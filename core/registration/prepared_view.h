/// @file  A view prepared for registration: smoothed profiles as splines, with box trees for fast
///          search.
#pragma once

#include <vector>

#include "core/base/index.h"
#include "core/geometry/box_tree.h"
#include "core/geometry/smoothing.h"
#include "core/geometry/spline.h"
#include "core/geometry/view.h"

namespace flytri::registration {

/// The direction of a shorter profile would be mostly noise.
inline constexpr std::size_t kMinProfilePoints = 6;

/// One smoothed line profile. Vectors are parallel to the knots of the curve.
struct PreparedProfile {
  CubicCurve curve;
  BoxTree tree;                       ///< over the knots
  std::vector<Vec3f> directions;      ///< o: unit tangents, smoother than the curve's own
  std::vector<Vec3f> deviations_mm;   ///< noise after smoothing, as in ProfilePoint
  Vec3 sheet_normal = Vec3::UnitX();  ///< s: unit normal of the light sheet
  ProfileIndex profile;               ///< index in the original view
  double depth_variation_mm = 0;      ///< standard deviation of z in the sensor frame
};

/// Prepared profiles of a view, in the sensor frame or, after moved(), in another frame.
struct PreparedView {
  Pattern pattern = Pattern::kVertical;
  std::vector<PreparedProfile> profiles;
  Vec3 center_mm = Vec3::Zero();        ///< mean of all knots
  double radius_mm = 0.0;               ///< RMS distance of the knots from it
  Vec3 line_direction = Vec3::UnitX();  ///< average direction of the profiles, unit
  double noise_mm = 0.0;                ///< median length of the deviations after smoothing

  [[nodiscard]] std::size_t knot_count() const;
  /// The same view in frame a.
  [[nodiscard]] PreparedView moved(const Isometry& T_a_b) const;
};

/// Smooths every profile that has at least kMinProfilePoints points; shorter ones are left out.
[[nodiscard]] PreparedView prepare_view(const View& view, const SmoothingOptions& options = {});

}  // namespace flytri::registration
