/// @file  PLY: meshes with any vertex properties in, meshes and point clouds out.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/geometry/triangle_mesh.h"

namespace flytri::io {

/// Vertex properties that a SurfacePoint has no place for, by name, parallel to the vertices.
using VertexProperties = std::map<std::string, std::vector<double>>;

/// What a PLY file holds. Without normals in the file they are computed from the triangles.
struct PlyMesh {
  TriangleMesh mesh;  ///< without triangles: a point cloud
  VertexProperties extra;
};

/// Reads ASCII or binary little-endian, scalar types of any kind and order; polygons become fans of
/// triangles. Positions in mm.
/// @param name  for messages
/// @errors  kBadFormat.
[[nodiscard]] Result<PlyMesh> parse_ply(std::string_view bytes, const std::string& name);

/// @errors  As read_file and parse_ply.
[[nodiscard]] Result<PlyMesh> read_ply(const std::filesystem::path& path);

/// Binary little-endian: float x, y, z, nx, ny, nz, uchar red, green, blue, float sigma,
/// then the extra ones as float; then faces.
/// @errors  As write_file; kInconsistent: an extra property of another length.
[[nodiscard]] Result<void> write_ply(const std::filesystem::path& path, const TriangleMesh& mesh,
                                     const VertexProperties& extra = {});

/// The same without faces.
/// @errors  As write_file.
[[nodiscard]] Result<void> write_point_cloud_ply(const std::filesystem::path& path,
                                                 const PointCloud& points);

}  // namespace flytri::io
