/// @file  Whether the texture of a model that was read can be used. Only for core/io/models.
#pragma once

#include <string>

#include "core/base/result.h"
#include "core/geometry/triangle_mesh.h"

namespace flytri::io {

/// @param name  of the file, for messages
/// @errors  kBadFormat: an atlas that is not 8-bit RGB, or vertices without texture coordinates.
[[nodiscard]] Result<void> check_texture(const TexturedMesh& model, const std::string& name);

}  // namespace flytri::io
