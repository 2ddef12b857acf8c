/// @file  Any bytes as rig.json: the reader accepts or refuses them; what it accepts is written and
/// read again the same.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "hw/rig/rig_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const auto rig = flytri::rig::parse_rig(bytes, "fuzz");
  if (!rig) return 0;
  const std::string written = flytri::rig::rig_to_json(*rig);
  const auto again = flytri::rig::parse_rig(written, "fuzz");
  if (!again || flytri::rig::rig_to_json(*again) != written) std::abort();
  return 0;
}
