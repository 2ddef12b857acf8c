/// @file  The median of values and what it says of their spread.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <vector>

namespace flytri {

/// Standard deviation of a normal distribution by its median absolute deviation.
inline constexpr double kSigmaOfMedian = 1.4826;

/// The value in the middle, of an even number the upper one. Reorders the values, at least one.
template <typename T>
T median_of(std::vector<T>& values) {
  assert(!values.empty());
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace flytri
