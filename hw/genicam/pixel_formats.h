/// @file  The names of pixel formats in GenICam.
#pragma once

#include <optional>
#include <string_view>

#include "hw/device/camera.h"

namespace flytri::genicam {

/// @source  EMVA, "GenICam Pixel Format Naming Convention" 2.1.
/// @return  nothing for MJPG, which GenICam does not have
[[nodiscard]] std::optional<std::string_view> genicam_name_of(device::PixelFormat format);
[[nodiscard]] std::optional<device::PixelFormat> pixel_format_of_genicam(std::string_view name);

}  // namespace flytri::genicam
