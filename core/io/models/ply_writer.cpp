#include <algorithm>
#include <cmath>

#include "core/io/files/byte_stream.h"
#include "core/io/models/ply.h"

namespace flytri::io {
namespace {

bool is_measured(const SurfacePoint& point) { return !std::isinf(point.sigma_mm); }

bool all_measured(const std::vector<SurfacePoint>& points) {
  return std::all_of(points.begin(), points.end(), is_measured);
}

std::string header_of(const std::vector<SurfacePoint>& points) {
  return fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment flytri, millimeters, sRGB\nelement vertex {}\n"
      "property float x\nproperty float y\nproperty float z\n"
      "property float nx\nproperty float ny\nproperty float nz\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty float sigma\n{}",
      points.size(), all_measured(points) ? "" : "property uchar measured\n");
}

std::string header_of(const VertexProperties& extra) {
  std::string text;
  for (const auto& [name, values] : extra) text += fmt::format("property float {}\n", name);
  return text;
}

void put_points(ByteWriter& out, const std::vector<SurfacePoint>& points,
                const VertexProperties& extra = {}) {
  const bool tells_measured = !all_measured(points);
  for (std::size_t v = 0; v < points.size(); ++v) {
    const SurfacePoint& point = points[v];
    for (int i = 0; i < 3; ++i) out.number(point.position_mm[i]);
    for (int i = 0; i < 3; ++i) out.number(point.normal[i]);
    for (const std::uint8_t channel : point.color) out.number(channel);
    out.number(is_measured(point) ? point.sigma_mm : 0.0F);
    if (tells_measured) out.number(std::uint8_t{is_measured(point)});
    for (const auto& [name, values] : extra) out.number(static_cast<float>(values[v]));
  }
}

void put_triangles(ByteWriter& out, const std::vector<Triangle>& triangles) {
  for (const Triangle& triangle : triangles) {
    out.number(std::uint8_t{3});
    for (const std::uint32_t vertex : triangle) out.number(static_cast<std::int32_t>(vertex));
  }
}

}  // namespace

Result<void> write_ply(const std::filesystem::path& path, const TriangleMesh& mesh,
                       const VertexProperties& extra) {
  for (const auto& [name, values] : extra) {
    if (values.size() == mesh.vertices.size()) continue;
    return fail(ErrorCode::kInconsistent,
                "{}: property {} has {} values, but there are {} vertices", path.string(), name,
                values.size(), mesh.vertices.size());
  }
  Result<ByteWriter> out = ByteWriter::create(path);
  if (!out) return tl::unexpected(out.error());
  out->text(header_of(mesh.vertices) + header_of(extra));
  out->text(fmt::format("element face {}\nproperty list uchar int vertex_indices\nend_header\n",
                        mesh.triangles.size()));
  put_points(*out, mesh.vertices, extra);
  put_triangles(*out, mesh.triangles);
  return out->commit();
}

Result<void> write_point_cloud_ply(const std::filesystem::path& path, const PointCloud& points) {
  Result<ByteWriter> out = ByteWriter::create(path);
  if (!out) return tl::unexpected(out.error());
  out->text(header_of(points));
  out->text("end_header\n");
  put_points(*out, points);
  return out->commit();
}

}  // namespace flytri::io
