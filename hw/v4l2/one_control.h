/// @file  Reads and writes one control of a camera.
#pragma once

#include <linux/videodev2.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hw/v4l2/video_modes.h"

namespace flytri::v4l2 {

/// Nothing if the camera lacks the control.
/// @param id  V4L2_CID_..., or with V4L2_CTRL_FLAG_NEXT_CTRL the next one
[[nodiscard]] std::optional<v4l2_queryctrl> query_control(VideoDevice& device, std::uint32_t id);

/// All numbers, switches and menus of the camera, as the driver lists them.
[[nodiscard]] std::vector<v4l2_queryctrl> query_controls(VideoDevice& device);

/// Nothing if it cannot be read.
[[nodiscard]] std::optional<std::int32_t> read_control(VideoDevice& device, std::uint32_t id);

/// Its name in the driver.
[[nodiscard]] std::string name_of(const v4l2_queryctrl& info);

[[nodiscard]] bool is_settable(const v4l2_queryctrl& info);

/// kIfChanged: some cameras refuse to set a value that is already set.
/// kAlways: a camera may have lost its values, and the driver does not know. An error counts only
/// if the camera has another value.
enum class WriteMode { kIfChanged, kAlways };

/// @errors  kBadOption if an automatic mode holds the control; else as video_failure
[[nodiscard]] Result<void> write_control(const OpenVideo& video, const v4l2_queryctrl& info,
                                         std::int32_t value, WriteMode mode);

}  // namespace flytri::v4l2
