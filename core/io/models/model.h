/// @file  Models of any format: the ending of the file's name chooses.
#pragma once

#include <filesystem>

#include "core/base/result.h"
#include "core/geometry/triangle_mesh.h"

namespace flytri::io {

/// Whether write_model would know the ending, before the work is done that leads to a model.
/// @errors  kBadOption: lists the endings.
[[nodiscard]] Result<void> check_model_path(const std::filesystem::path& path);

/// Whether the format of this ending carries a texture atlas. In the others the vertices of an
/// uncut mesh, with a color each, serve better.
[[nodiscard]] bool carries_atlas(const std::filesystem::path& path);

/// Writes .glb, .ply, .stl or .obj (with .mtl and .png), at once or not at all.
/// @errors  kBadOption (ending), kInsufficient (no triangles), kInconsistent (an index or a number
///          that cannot be), as write_file.
[[nodiscard]] Result<void> write_model(const std::filesystem::path& path,
                                       const TexturedMesh& model);

/// Reads what write_model wrote, and any mesh in PLY, in mm of the world frame.
/// @errors  kBadOption (ending), as read_file and the parsers.
[[nodiscard]] Result<TexturedMesh> read_model(const std::filesystem::path& path);

}  // namespace flytri::io
