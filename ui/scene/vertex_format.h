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

/// A unit vector in 10 bits a component, as GL_INT_2_10_10_10_REV: 0.1 degrees.
[[nodiscard]] std::uint32_t packed_normal(const Vec3f& normal);

/// Red, green, blue and flags from the lowest byte on.
[[nodiscard]] std::uint32_t packed_color(const Rgb& color, std::uint8_t flags);

/// True if one of the brush's dabs reaches a place.
[[nodiscard]] bool reaches(const std::vector<editing::BrushDab>& dabs, const Vec3f& position_mm,
                           const Vec3f& normal);

[[nodiscard]] bool are_same(const std::vector<editing::BrushDab>& a,
                            const std::vector<editing::BrushDab>& b);

}  // namespace flytri::ui
