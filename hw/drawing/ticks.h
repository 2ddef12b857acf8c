/// @file  Values at the lines of an axis.
#pragma once

namespace flytri::drawing {

/// The distance of an axis' lines: 1, 2 or 5 times a power of ten, at most four steps in
/// `length`.
/// @param length  > 0, of the axis, in its unit
[[nodiscard]] double tick_step(double length);

}  // namespace flytri::drawing
