/// @file  Wavefront OBJ, in mm; the texture is a PNG file beside it, named by an MTL file.
///
/// The reader exists because `flytri evaluate` and `--mesh` take every format that flytri writes,
/// and because the tests read back each exported model.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/geometry/triangle_mesh.h"

namespace flytri::io {

/// What the text of an .obj file holds.
struct ObjText {
  TexturedMesh model;     ///< without the atlas; v of the texture coordinates runs down, as in ours
  std::string materials;  ///< name of the material file; empty: none
};

/// Vertices may carry colors (v x y z r g b, 0..1); polygons become fans of triangles.
/// @param name  for messages
/// @errors  kBadFormat naming the line.
[[nodiscard]] Result<ObjText> parse_obj(std::string_view text, const std::string& name);

/// Also reads the texture that the material file names.
/// @errors  As read_file, parse_obj, read_png.
[[nodiscard]] Result<TexturedMesh> read_obj(const std::filesystem::path& path);

/// Writes the .obj file. With an atlas, also the .mtl and .png files of the same name: all three
/// files appear, or none. Without an atlas the vertices have colors.
/// @errors  As commit_together and encode_png.
[[nodiscard]] Result<void> write_obj(const std::filesystem::path& path, const TexturedMesh& model);

}  // namespace flytri::io
