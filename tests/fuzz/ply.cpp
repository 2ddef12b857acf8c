/// @file  Any bytes as a PLY file: the reader accepts or refuses them, and never crashes.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "core/io/models/ply.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  (void)flytri::io::parse_ply(bytes, "fuzz");
  return 0;
}
