/// @file  A measured view as a compact string of bytes, and back, bit for bit.
///
/// Little-endian. What a view's points have in common comes first, then their numbers column by
/// column: x, y, z (f64), deviation x, y, z, along (f32). Each number is told by how far its bits
/// lie from those of the point before it on the profile; the bytes of equal weight stand together
/// (a plane), so that the leading ones, which hardly change, are packed well. Planes that noise
/// fills are stored as they are.
///
///     u8   version, 1
///     u8   pattern: 0 vertical, 1 horizontal
///     i32  frame            f64  time_s
///     u32  profile_count    u32  point_count
///     profile_count times: i32 line, u32 point count, f64 sheet_normal[3]
///     u64  which of the 40 planes are packed: bit 0 is the most significant byte of x
///     u32  size of the zlib stream
///     the zlib stream of the packed planes, then the other planes, point_count bytes each
#pragma once

#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/geometry/view.h"

namespace flytri::io {

[[nodiscard]] std::string encode_view(const View& view);

/// Gives back the very bits that encode_view was given.
/// @errors  kBadFormat: not the bytes of a view.
[[nodiscard]] Result<View> decode_view(std::string_view bytes);

}  // namespace flytri::io
