/// @file  Reads PLY meshes with any vertex properties; writes meshes and point clouds.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/geometry/triangle_mesh.h"

namespace flytri::io {

/// Further properties that SurfacePoint does not have, by name: one value per vertex.
using VertexProperties = std::map<std::string, std::vector<double>>;

/// The content of a PLY file. Missing normals are computed from the triangles.
struct PlyMesh {
  TriangleMesh mesh;  ///< a point cloud has no triangles
  VertexProperties extra;
};

/// Reads ASCII or binary little-endian PLY, with scalars of any type in any order. Polygons become
/// fans of triangles. Positions are in mm.
/// @param name  for messages
/// @errors  kBadFormat.
[[nodiscard]] Result<PlyMesh> parse_ply(std::string_view bytes, const std::string& name);

/// @errors  As read_file and parse_ply.
[[nodiscard]] Result<PlyMesh> read_ply(const std::filesystem::path& path);

/// Binary little-endian: float x, y, z, nx, ny, nz, uchar red, green, blue, float sigma, uchar
/// measured if some were not, then the extra properties as float; then faces.
/// @errors  As write_file; kInconsistent: an extra property has the wrong number of values.
[[nodiscard]] Result<void> write_ply(const std::filesystem::path& path, const TriangleMesh& mesh,
                                     const VertexProperties& extra = {});

/// The same without faces.
/// @errors  As write_file.
[[nodiscard]] Result<void> write_point_cloud_ply(const std::filesystem::path& path,
                                                 const PointCloud& points);

}  // namespace flytri::io
