/// @file  glTF 2.0 binary: a textured mesh out, and our own exports in again.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/geometry/triangle_mesh.h"

namespace flytri::io {

/// The bytes of a .glb. The buffers keep millimetres of the world frame; the root node scales them
/// to metres and turns them by half a turn about x, so that +y is up. With an atlas there are
/// texture coordinates and a PNG inside, without it vertex colors, linear as glTF has them.
/// @param name  for messages
/// @errors  kBadOption: larger than the 4 GiB that the format can hold; as encode_png.
[[nodiscard]] Result<std::string> encode_glb(const TexturedMesh& model, const std::string& name);

/// Inverse of encode_glb; other programs' files are refused where they are built otherwise.
/// Standard uncertainties are not in the file and come back as 0.
/// @param name  for messages
/// @errors  kBadFormat.
[[nodiscard]] Result<TexturedMesh> parse_glb(std::string_view bytes, const std::string& name);

/// @errors  As encode_glb and write_file.
[[nodiscard]] Result<void> write_glb(const std::filesystem::path& path, const TexturedMesh& model);

}  // namespace flytri::io
