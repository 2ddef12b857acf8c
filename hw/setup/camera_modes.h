/// @file  Which of a camera's formats, sizes and rates suit a rig.
#pragma once

#include <vector>

#include "hw/device/camera.h"

namespace flytri::setup {

/// Slowest usable rate, as a share of the wanted one: the hand would have to move too slowly.
inline constexpr double kSlowestShare = 1.0 / 3.0;

/// The settings that suit a camera, best first: raw formats before converted and compressed ones,
/// then the size nearest to 1024 x 768 (measurement camera) or 1280 x 960 (texture camera). Each
/// has the rate nearest to the wanted one; slow ones come last.
/// @param channels  kGrey for the measurement camera, kRgb for the texture camera
/// @param rate_hz  > 0. A camera that does not tell its rates is expected to have this one.
/// @return  empty: the camera has no such format at kSlowestShare of the rate or more
[[nodiscard]] std::vector<device::CameraSettings> suitable_settings(
    const std::vector<device::CameraMode>& modes, device::Channels channels, double rate_hz);

/// Whether the camera has gray formats only.
[[nodiscard]] bool is_monochrome(const std::vector<device::CameraMode>& modes);

/// "GREY, 1024 x 768 at 30 Hz".
[[nodiscard]] std::string text_of(const device::CameraSettings& settings);

}  // namespace flytri::setup
