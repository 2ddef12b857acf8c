/// @file  Lists and sets the formats, sizes and rates of a camera.
#pragma once

#include <vector>

#include "hw/device/camera.h"
#include "hw/stream/pixel_conversion.h"
#include "hw/v4l2/video_system.h"

namespace flytri::v4l2 {

/// An open device file, and its description for messages. Not owned.
struct OpenVideo {
  VideoDevice& device;
  const device::DeviceNode& node;
};

/// All modes of the camera. For a range of sizes or rates, only the ends are listed.
[[nodiscard]] std::vector<device::CameraMode> list_modes(VideoDevice& device);

/// The mode that the driver accepted.
struct AgreedMode {
  stream::BufferLayout layout;
  double rate_hz = 0.0;  ///< the requested rate if the driver reports none
};

/// Sets format, size and rate.
/// @errors  kBadOption: unsupported format or size, with the available modes; else as video_failure
[[nodiscard]] Result<AgreedMode> set_mode(const OpenVideo& video,
                                          const device::CameraSettings& settings);

/// Checks whether the camera supports format and size, without setting them.
/// @errors  As set_mode.
[[nodiscard]] Result<void> check_mode(const OpenVideo& video,
                                      const device::CameraSettings& settings);

}  // namespace flytri::v4l2
