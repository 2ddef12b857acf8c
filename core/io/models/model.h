/// @file  Reads and writes models; the extension of the file name chooses the format.
#pragma once

#include <filesystem>
#include <vector>

#include "core/base/result.h"
#include "core/geometry/triangle_mesh.h"

namespace flytri::io {

/// Whether write_model knows the extension; call it before the work that leads to a model.
/// @errors  kBadOption: lists the extensions.
[[nodiscard]] Result<void> check_model_path(const std::filesystem::path& path);

/// Whether the format holds a texture atlas.
[[nodiscard]] bool holds_texture(const std::filesystem::path& path);

/// All files that write_model may write: the path itself, and for .obj its .mtl and .png.
[[nodiscard]] std::vector<std::filesystem::path> files_of_model(const std::filesystem::path& path);

/// Writes a model, all of its files or none; see model_formats.h for the formats. Only their owner
/// may read the files, as they show a patient's jaw.
/// @errors  kBadOption (extension), kInsufficient (no triangles), kInconsistent (an index out of
///          range, or a number that is not finite), as commit_together.
[[nodiscard]] Result<void> write_model(const std::filesystem::path& path,
                                       const TexturedMesh& model);

/// As above: `cut` where the format holds a texture atlas, elsewhere `uncut`.
/// @param cut    the model, cut into charts if it has a texture
/// @param uncut  the same surface, with a color per vertex
[[nodiscard]] Result<void> write_model(const std::filesystem::path& path, const TexturedMesh& cut,
                                       const TriangleMesh& uncut);

/// Reads what write_model wrote, and any mesh in PLY, in mm of the world frame.
/// @errors  kBadOption (extension), as read_file and the parsers.
[[nodiscard]] Result<TexturedMesh> read_model(const std::filesystem::path& path);

}  // namespace flytri::io
