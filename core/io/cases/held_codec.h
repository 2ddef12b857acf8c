/// @file  Encodes the surface of a finished model for the next run, and decodes it bit for bit.
///
/// Little-endian:
///
///     f64  spacing_mm       f64  seen_until_s
///     u32  number of edits, of views, of texture frames, of points, of vertices
///     the edits: f64 made_at_s
///     the views: f64 time_s, f64[12] pose as in the table of poses
///     the texture frames: the same, f32[3] gain
///     the points, then the vertices: f32[3] position (mm), f32[3] normal, f32 sigma (mm),
///                                    u8[3] color (R, G, B), u8 patterns
#pragma once

#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/editing/held_surface.h"

namespace flytri::io {

[[nodiscard]] std::string encode_held_surface(const editing::HeldSurface& held);

/// Returns exactly the surface that encode_held_surface() encoded.
/// @errors  kBadFormat: the bytes are not those of a surface that a sensor can have measured.
[[nodiscard]] Result<editing::HeldSurface> decode_held_surface(std::string_view bytes);

}  // namespace flytri::io
