/// @file  What a frame shows, as files name it.
///
/// For the sources of core/interchange only.
#pragma once

#include <string_view>

#include "core/imaging/frame.h"
#include "core/io/files/json_place.h"

namespace flytri::io {

/// "vertical", "horizontal", "texture" or "unknown".
[[nodiscard]] std::string_view to_string(FrameKind kind);

/// Any other text is rejected at its place.
[[nodiscard]] FrameKind read_frame_kind(const JsonPlace& place);

}  // namespace flytri::io
