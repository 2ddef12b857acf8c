/// @file  How something in the image moves with the depth of the plane, and where it is to be next.
#pragma once

#include <map>
#include <optional>
#include <utility>

namespace flytri::calibration {

/// What the planes so far lead to expect at a depth.
struct DepthPrediction {
  double value = 0.0;
  double slope_per_mm = 0.0;  ///< 0 where only one plane is known
  double error_mm = 0.0;      ///< by how much the depth told from it may be wrong
};

/// A quantity that depends smoothly on the depth, known on some planes.
class DepthTrack {
 public:
  void set(double z_mm, double value) { values_[z_mm] = value; }
  void forget(double z_mm) { values_.erase(z_mm); }

  /// From up to three of the other planes, those nearest to z_mm, by their parabola.
  ///
  /// What projections and lenses do is nearly a hyperbola of the distance, which a parabola over
  /// steps that are small against the distance meets to a share of a step; a straight line less so.
  /// @return  nothing without another plane
  [[nodiscard]] std::optional<DepthPrediction> predict(double z_mm) const;

  /// Depth and value of the other plane that is nearest.
  [[nodiscard]] std::optional<std::pair<double, double>> nearest(double z_mm) const;

 private:
  std::map<double, double> values_;  // by depth
};

}  // namespace flytri::calibration
