/// @file  How far compressed data can grow, to refuse what claims more before room is made for it.
#pragma once

#include <cstdint>

namespace flytri::io {

/// Deflate cannot shrink data further than this, so a small file with a huge size is a lie.
inline constexpr std::uint64_t kMaxDeflateRatio = 1032;

}  // namespace flytri::io
