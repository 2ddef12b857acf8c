/// @file  Any bytes as report.json: the reader accepts or refuses them, and never crashes.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "app/cli/report.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  (void)flytri::cli::parse_report(bytes, "fuzz");
  return 0;
}
