/// @file  Levels the brightness of texture frames to each other.
#pragma once

#include <span>

#include "core/texture/observe.h"

namespace flytri::texture {

/// Sets the gains of the frames, so that a place has the same color in all of them. The brightness
/// of a flash varies, and a camera may change its exposure and white balance. The mean of all
/// frames stays as it is.
/// @param points  of the surface, world frame
/// @errors  kBadOption; as check_texture_image.
[[nodiscard]] Result<void> level_frames(std::span<TextureFrame> frames,
                                        std::span<const SurfacePoint> points,
                                        const calibration::Calibration& calibration,
                                        const TextureOptions& options, const Workers& workers);

}  // namespace flytri::texture
