/// @file  The colors with a meaning, distinguishable with any color vision.
#pragma once

#include <array>

#include "core/scan/scan_snapshot.h"

namespace flytri::ui {

/// sRGB with opacity, each 0..1.
using Color = std::array<float, 4>;

/// @source  Okabe and Ito, "Color Universal Design", 2008.
inline constexpr Color kGood = {0.00F, 0.62F, 0.45F, 1.0F};     ///< bluish green
inline constexpr Color kCaution = {0.90F, 0.62F, 0.00F, 1.0F};  ///< orange
inline constexpr Color kBad = {0.84F, 0.37F, 0.00F, 1.0F};      ///< vermilion
inline constexpr Color kNeutral = {0.34F, 0.71F, 0.91F, 1.0F};  ///< sky blue

/// Rims of holes; the selected one is seen on every surface.
inline constexpr Color kHole = {0.84F, 0.37F, 0.00F, 1.0F};  ///< vermilion
inline constexpr Color kSelectedHole = {1.00F, 1.00F, 1.00F, 1.0F};

/// Measured lines by their pattern, in the scene and in the small preview.
inline constexpr Color kVerticalProfile = {1.00F, 0.84F, 0.20F, 1.0F};    ///< amber
inline constexpr Color kHorizontalProfile = {0.35F, 0.88F, 1.00F, 1.0F};  ///< cyan

/// The color of the frame around the scene: readable from two meters.
[[nodiscard]] Color status_color(scan::ScanPhase phase);

}  // namespace flytri::ui
