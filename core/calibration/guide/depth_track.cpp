#include "core/calibration/guide/depth_track.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace flytri::calibration {
namespace {

constexpr std::size_t kMaxPlanes = 3;
/// Error of the prediction, as a share of the distance to the nearest plane, for a line and a
/// parabola.
constexpr double kLineError = 0.25;
constexpr double kParabolaError = 0.05;

using Point = std::pair<double, double>;

/// All points but the one at `z`, the nearest first.
std::vector<Point> by_distance(const std::map<double, double>& values, double z) {
  std::vector<Point> points;
  for (const auto& point : values) {
    if (point.first != z) points.emplace_back(point);
  }
  std::stable_sort(points.begin(), points.end(), [&](const Point& a, const Point& b) {
    return std::abs(a.first - z) < std::abs(b.first - z);
  });
  return points;
}

/// Newton's divided differences: value and slope at `z` of the polynomial through the points.
std::pair<double, double> polynomial_at(std::vector<Point> points, double z) {
  const std::size_t n = points.size();
  for (std::size_t order = 1; order < n; ++order) {
    for (std::size_t i = n - 1; i >= order; --i) {
      points[i].second =
          (points[i].second - points[i - 1].second) / (points[i].first - points[i - order].first);
    }
  }
  double value = 0.0, slope = 0.0;
  for (std::size_t i = n; i-- > 0;) {
    slope = slope * (z - points[i].first) + value;
    value = value * (z - points[i].first) + points[i].second;
  }
  return {value, slope};
}

}  // namespace

std::optional<DepthPrediction> DepthTrack::predict(double z_mm) const {
  std::vector<Point> points = by_distance(values_, z_mm);
  if (points.empty()) return std::nullopt;
  points.resize(std::min(points.size(), kMaxPlanes));
  const double step_mm = std::abs(points.front().first - z_mm);
  const auto [value, slope] = polynomial_at(points, z_mm);
  const double share = points.size() < kMaxPlanes ? kLineError : kParabolaError;
  return DepthPrediction{value, slope, share * step_mm};
}

std::optional<std::pair<double, double>> DepthTrack::nearest(double z_mm) const {
  const std::vector<Point> points = by_distance(values_, z_mm);
  if (points.empty()) return std::nullopt;
  return points.front();
}

}  // namespace flytri::calibration
