/// @file  How far compressed data can grow: a file that claims more is refused before memory is
/// reserved for it.
#pragma once

#include <cstdint>

namespace flytri::io {

/// Deflate cannot compress better than this, so a small file that claims a huge size is damaged.
inline constexpr std::uint64_t kMaxDeflateRatio = 1032;

}  // namespace flytri::io
