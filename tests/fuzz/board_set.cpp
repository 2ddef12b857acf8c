/// @file  Any bytes as board-set.json: the reader accepts or refuses them, and never crashes.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "core/io/calibrations/board_set_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  (void)flytri::io::parse_board_set(bytes, "fuzz");
  return 0;
}
