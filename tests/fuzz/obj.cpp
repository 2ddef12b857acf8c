/// @file  Any bytes as an OBJ file: the reader accepts or refuses them; what it accepts can be
/// compared, with a texture beside it.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "core/evaluation/color_error.h"
#include "core/io/models/obj.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  auto obj = flytri::io::parse_obj(bytes, "fuzz");
  if (!obj) return 0;
  if (!obj->model.uv.empty()) obj->model.atlas = cv::Mat(4, 4, CV_8UC3, cv::Scalar(1, 2, 3));
  (void)flytri::evaluation::color_error(obj->model, obj->model.mesh, 1.0, flytri::Workers(1));
  return 0;
}
