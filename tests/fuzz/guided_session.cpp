/// @file  Any bytes as calibration-session.json: the reader accepts or refuses them; what it
/// accepts is a plan that can be carried out.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "core/io/calibrations/guided_session_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const auto plan = flytri::io::parse_guided_plan(bytes, "fuzz");
  if (plan && flytri::calibration::placements_of(*plan).size() != 2 * plan->z_mm.size())
    std::abort();
  return 0;
}
