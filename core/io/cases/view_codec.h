/// @file  Encodes a measured view as a compact string of bytes, and decodes it bit for bit.
///
/// Little-endian. A header comes first, then the numbers of the points, column by column: x, y, z
/// (f64), deviation x, y, z, along (f32). Each number is stored as the difference of its bits from
/// those of the previous point on the profile. Bytes of equal weight are stored together, as a
/// plane. The planes of high weight hardly change and compress well; planes full of noise are not
/// compressed.
///
///     u8   version, 1
///     u8   pattern: 0 vertical, 1 horizontal
///     i32  frame            f64  time_s
///     u32  profile_count    u32  point_count
///     profile_count times: i32 line, u32 point count, f64 sheet_normal[3]
///     u64  which of the 40 planes are compressed: bit 0 is the most significant byte of x
///     u32  size of the zlib stream
///     the zlib stream of the compressed planes, then the other planes, point_count bytes each
#pragma once

#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/geometry/view.h"

namespace flytri::io {

[[nodiscard]] std::string encode_view(const View& view);

/// Returns exactly the view that encode_view() encoded.
/// @errors  kBadFormat: the bytes are not those of a view.
[[nodiscard]] Result<View> decode_view(std::string_view bytes);

}  // namespace flytri::io
