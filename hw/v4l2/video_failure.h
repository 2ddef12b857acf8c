/// @file  What a system call's errno means for a camera, and its remedy.
#pragma once

#include <string_view>

#include "core/base/result.h"
#include "hw/v4l2/video_system.h"

namespace flytri::v4l2 {

/// @param doing  what failed, e.g. "starting the stream"
/// @return  kNotFound: it is unplugged, or does not answer; kNotPermitted; kInconsistent: in use;
///          kBadOption: it, or the bus, cannot do what is asked
[[nodiscard]] Error video_failure(const device::DeviceNode& node, std::string_view doing,
                                  int error_number);

/// How messages name a camera, e.g. "Mono Camera (serial 12, /dev/video0)".
[[nodiscard]] std::string to_string(const device::DeviceNode& node);

}  // namespace flytri::v4l2
