/// @file  Colors points from texture frames.
#pragma once

#include <cstddef>
#include <span>

#include "core/texture/observe.h"

namespace flytri::texture {

/// Number of points by the source of their color.
struct ColorCounts {
  std::size_t observed = 0;    ///< seen by at least one texture frame
  std::size_t extended = 0;    ///< taken from the nearest observed point
  std::size_t untextured = 0;  ///< kUntexturedColor
};

/// Colors each observed point from the frames, see FrameObserver and merge_observations(); the
/// others from their neighbors.
/// @param points  world frame; only their colors change
/// @param progress  advanced by one step
/// @errors  kBadOption, kCancelled; as check_texture_image.
[[nodiscard]] Result<ColorCounts> color_points(std::span<SurfacePoint> points,
                                               std::span<const TextureFrame> frames,
                                               const calibration::Calibration& calibration,
                                               const TextureOptions& options,
                                               const Workers& workers,
                                               const Progress& progress = {});

}  // namespace flytri::texture
