/// @file  Binary STL: triangles in mm, nothing else.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/geometry/triangle_mesh.h"

namespace flytri::io {

/// Corners at exactly the same place become one vertex again; normals are computed.
/// @param name  for messages
/// @errors  kBadFormat; the text form of STL is refused.
[[nodiscard]] Result<TriangleMesh> parse_stl(std::string_view bytes, const std::string& name);

/// @errors  As write_file; kBadOption: more triangles than the format can count.
[[nodiscard]] Result<void> write_stl(const std::filesystem::path& path, const TriangleMesh& mesh);

}  // namespace flytri::io
