/// @file  Any bytes as a binary glTF file: the reader accepts or refuses them; what it accepts can
/// be shown, compared and written again.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "core/evaluation/color_error.h"
#include "core/io/models/glb.h"
#include "core/reconstruct/finish_scan.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const auto model = flytri::io::parse_glb(bytes, "fuzz");
  if (!model) return 0;
  (void)flytri::evaluation::color_error(*model, model->mesh, 1.0, flytri::Workers(1));
  (void)flytri::reconstruct::finished_scan_of(*model);
  (void)flytri::io::encode_glb(*model, "fuzz");
  return 0;
}
