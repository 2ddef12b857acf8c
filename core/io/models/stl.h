/// @file  Binary STL: only triangles, in mm.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/geometry/triangle_mesh.h"

namespace flytri::io {

/// Corners at exactly the same position become one vertex; normals are computed.
/// @param name  for messages
/// @errors  kBadFormat; STL as text is refused.
[[nodiscard]] Result<TriangleMesh> parse_stl(std::string_view bytes, const std::string& name);

/// @errors  As read_file and parse_stl.
[[nodiscard]] Result<TriangleMesh> read_stl(const std::filesystem::path& path);

/// @errors  As write_file; kBadOption: too many triangles for the format.
[[nodiscard]] Result<void> write_stl(const std::filesystem::path& path, const TriangleMesh& mesh);

}  // namespace flytri::io
