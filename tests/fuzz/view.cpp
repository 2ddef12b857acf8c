/// @file  Any bytes as a view of a case: the reader refuses them, or the same view is written again; it never crashes.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "core/io/cases/view_codec.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const auto view = flytri::io::decode_view(bytes);
  if (!view) return 0;
  // Other bytes may stand for the same view; those that we write are the same each time.
  const std::string written = flytri::io::encode_view(*view);
  const auto again = flytri::io::decode_view(written);
  if (!again || flytri::io::encode_view(*again) != written) std::abort();
  return 0;
}
