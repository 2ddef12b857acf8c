/// @file  The formats, sizes and rates of a camera: what it offers, and setting one of them.
#pragma once

#include <vector>

#include "hw/device/camera.h"
#include "hw/v4l2/pixel_conversion.h"
#include "hw/v4l2/video_system.h"

namespace flytri::v4l2 {

/// An open device file and its name in messages. Owned by someone else.
struct OpenVideo {
  VideoDevice& device;
  const device::DeviceNode& node;
};

/// All that it offers. Of a range of sizes or rates its ends stand for all.
[[nodiscard]] std::vector<device::CameraMode> list_modes(VideoDevice& device);

/// What the driver agreed to.
struct AgreedMode {
  BufferLayout layout;
  double rate_hz = 0.0;  ///< as asked where the driver does not say
};

/// Sets format, size and rate.
/// @errors  kBadOption: no such format or size, with those that there are; else as video_failure
[[nodiscard]] Result<AgreedMode> set_mode(const OpenVideo& video,
                                          const device::CameraSettings& settings);

/// Whether it would take format and size; nothing is set.
/// @errors  As set_mode.
[[nodiscard]] Result<void> check_mode(const OpenVideo& video,
                                      const device::CameraSettings& settings);

}  // namespace flytri::v4l2
