/// @file  The square of a number.
#pragma once

namespace flytri {

template <typename T>
[[nodiscard]] constexpr T square(T x) {
  return x * x;
}

}  // namespace flytri
