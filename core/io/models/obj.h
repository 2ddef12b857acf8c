/// @file  Wavefront OBJ with MTL and PNG beside it, in mm.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/geometry/triangle_mesh.h"

namespace flytri::io {

/// The text of an .obj file without what it refers to.
struct ObjText {
  TexturedMesh model;     ///< uv as the file has them turned to our orientation; no atlas
  std::string materials;  ///< the material library it names; empty: none
};

/// Vertices may carry colors (v x y z r g b, 0..1); polygons become fans of triangles.
/// @param name  for messages
/// @errors  kBadFormat naming the line.
[[nodiscard]] Result<ObjText> parse_obj(std::string_view text, const std::string& name);

/// With the atlas that its materials name.
/// @errors  As read_file, parse_obj, read_png.
[[nodiscard]] Result<TexturedMesh> read_obj(const std::filesystem::path& path);

/// Writes path, and with an atlas the .mtl and .png of the same name beside it. The .obj comes
/// last. Without an atlas the vertices carry their colors.
/// @errors  As write_file and write_png.
[[nodiscard]] Result<void> write_obj(const std::filesystem::path& path, const TexturedMesh& model);

}  // namespace flytri::io
