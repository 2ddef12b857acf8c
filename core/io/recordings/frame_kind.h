/// @file  Names of frame kinds in files. Only for core/io.
#pragma once

#include <string_view>

#include "core/imaging/frame.h"
#include "core/io/files/json_place.h"

namespace flytri::io {

/// "vertical", "horizontal", "texture" or "unknown".
[[nodiscard]] std::string_view to_string(FrameKind kind);

/// Rejects any other text at its place.
[[nodiscard]] FrameKind read_frame_kind(const JsonPlace& place);

}  // namespace flytri::io
