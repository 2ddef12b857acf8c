/// @file  How positions, normals and colors are packed for the graphics memory.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/editing/edits.h"
#include "core/geometry/point_cloud.h"

namespace flytri::ui {

/// Flags of a vertex, in the alpha of its color; the shaders use the same bits.
inline constexpr std::uint8_t kTexturedFlag = 1;
inline constexpr std::uint8_t kGoodFlag = 2;
inline constexpr std::uint8_t kLockedFlag = 4;
inline constexpr std::uint8_t kNotMeasuredFlag = 16;  // of a closed hole; 8 is to trim
inline constexpr std::uint8_t kToTrimFlag = 8;
inline constexpr std::uint8_t kLowerJawFlag = 32;  ///< of two jaws that are shown together

/// The brush strokes that tint the model.
struct Tints {
  std::vector<editing::BrushDab> locked;
  std::vector<editing::BrushDab> to_trim;  ///< of the stroke that is being painted
};

/// A unit vector in 10 bits a component, as GL_INT_2_10_10_10_REV: 0.1 degrees.
[[nodiscard]] std::uint32_t packed_normal(const Vec3f& normal);

/// Red, green, blue and flags from the lowest byte on.
[[nodiscard]] std::uint32_t packed_color(const Rgb& color, std::uint8_t flags);

/// The flag of the tint at a place, or 0. A locked place is not trimmed.
[[nodiscard]] std::uint8_t tint_flag(const Tints& tints, const Vec3f& position_mm,
                                     const Vec3f& normal);

/// The dabs that reach into a box.
[[nodiscard]] Tints within(const Tints& tints, const Eigen::AlignedBox3f& box);

[[nodiscard]] bool are_same(const Tints& a, const Tints& b);

}  // namespace flytri::ui
