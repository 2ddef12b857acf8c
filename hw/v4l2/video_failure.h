/// @file  Error messages for failed system calls on a camera: the cause and what to do.
#pragma once

#include <string_view>

#include "core/base/result.h"
#include "hw/v4l2/video_system.h"

namespace flytri::v4l2 {

/// @param doing  the failed action, e.g. "starting the stream"
/// @return  kNotFound: unplugged, or it does not answer; kNotPermitted; kInconsistent: in use;
///          kBadOption: the camera or the bus does not support the setting
[[nodiscard]] Error video_failure(const device::DeviceNode& node, std::string_view doing,
                                  int error_number);

/// Name of a camera in messages, e.g. "Mono Camera (serial 12, /dev/video0)".
[[nodiscard]] std::string to_string(const device::DeviceNode& node);

}  // namespace flytri::v4l2
