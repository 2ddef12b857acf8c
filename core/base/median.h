/// @file  Median and other quantiles, and the spread that the median gives.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <vector>

namespace flytri {

/// Median absolute deviation of a normal distribution, in standard deviations.
inline constexpr double kMedianOfSigma = 0.6745;
/// Its standard deviation, in median absolute deviations: 1 / kMedianOfSigma.
inline constexpr double kSigmaOfMedian = 1.4826;

/// The middle value; the upper one of the two if their number is even. Reorders the values. Needs
/// at least one value.
template <typename T>
T median_of(std::vector<T>& values) {
  assert(!values.empty());
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// The value below which `share` of the sorted values lies, interpolated linearly. Needs at least
/// one value.
inline double quantile_of(const std::vector<double>& sorted, double share) {
  assert(!sorted.empty());
  const double place = share * static_cast<double>(sorted.size() - 1);
  const auto i = static_cast<std::size_t>(place);
  if (i + 1 >= sorted.size()) return sorted.back();
  return sorted[i] + (place - static_cast<double>(i)) * (sorted[i + 1] - sorted[i]);
}

}  // namespace flytri
