/// @file  Predicts how a quantity in the image changes with the depth of the plane.
#pragma once

#include <map>
#include <optional>
#include <utility>

namespace flytri::calibration {

/// Prediction at a depth, from the planes so far.
struct DepthPrediction {
  double value = 0.0;
  double slope_per_mm = 0.0;  ///< 0 if only one plane is known
  double error_mm = 0.0;      ///< error of a depth computed from this prediction
};

/// A quantity that depends smoothly on the depth, known on some planes.
class DepthTrack {
 public:
  void set(double z_mm, double value) { values_[z_mm] = value; }
  void forget(double z_mm) { values_.erase(z_mm); }

  /// Predicts by a parabola through the up to three other planes nearest to z_mm.
  ///
  /// In a projection, the quantity is nearly a hyperbola of the distance. For small steps a
  /// parabola approximates it to a small share of a step; a straight line is less accurate.
  /// @return nullopt without another plane
  [[nodiscard]] std::optional<DepthPrediction> predict(double z_mm) const;

  /// Depth and value of the nearest other plane.
  [[nodiscard]] std::optional<std::pair<double, double>> nearest(double z_mm) const;

 private:
  std::map<double, double> values_;  // by depth
};

}  // namespace flytri::calibration
