#include "core/io/models/check_texture.h"

#include <algorithm>

namespace flytri::io {

Result<void> check_texture(const TexturedMesh& model, const std::string& name) {
  if (!model.atlas.empty() && model.atlas.type() != CV_8UC3) {
    return fail(ErrorCode::kBadFormat,
                "{}: its texture must be an 8-bit RGB image; save the image in color and try again",
                name);
  }
  const bool is_needed = !model.atlas.empty() || !model.uv.empty();
  if (is_needed && model.uv.size() != model.mesh.vertices.size()) {
    return fail(ErrorCode::kBadFormat,
                "{}: {} of {} vertices have texture coordinates; export the model again, with "
                "coordinates for all vertices or without a texture",
                name, model.uv.size(), model.mesh.vertices.size());
  }
  if (std::all_of(model.uv.begin(), model.uv.end(), [](const auto& uv) { return uv.allFinite(); }))
    return {};
  return fail(ErrorCode::kBadFormat,
              "{}: a texture coordinate is not a finite number; export the model again", name);
}

}  // namespace flytri::io
