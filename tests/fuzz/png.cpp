/// @file  Any bytes as a PNG image: the reader accepts or refuses them, and never crashes.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "core/io/files/png.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  (void)flytri::io::decode_png(bytes, "fuzz");
  return 0;
}
