#include "core/io/models/stl.h"

#include <array>
#include <limits>
#include <map>

#include "core/geometry/mesh_normals.h"
#include "core/io/files/byte_stream.h"
#include "core/io/files/file_bytes.h"

namespace flytri::io {
namespace {

constexpr std::size_t kHeaderSize = 80;
constexpr std::size_t kTriangleSize = 50;  // normal, three corners, two unused bytes

Vec3f triangle_normal(const Vec3f& a, const Vec3f& b, const Vec3f& c) {
  const Vec3 normal = (b - a).cast<double>().cross((c - a).cast<double>());
  return normal.norm() > 0.0 ? Vec3f(normal.normalized().cast<float>()) : Vec3f::Zero();
}

void put_vector(ByteWriter& out, const Vec3f& vector) {
  for (int i = 0; i < 3; ++i) out.number(vector[i]);
}

/// Gives equal positions the same index.
class Welder {
 public:
  explicit Welder(TriangleMesh& mesh) : mesh_(mesh) {}
  std::uint32_t index_of(const Vec3f& position) {
    const auto next = static_cast<std::uint32_t>(mesh_.vertices.size());
    const auto [at, is_new] =
        indices_.try_emplace({position.x(), position.y(), position.z()}, next);
    if (is_new) mesh_.vertices.emplace_back().position_mm = position;
    return at->second;
  }

 private:
  TriangleMesh& mesh_;
  std::map<std::array<float, 3>, std::uint32_t> indices_;
};

}  // namespace

Result<TriangleMesh> parse_stl(std::string_view bytes, const std::string& name) {
  if (bytes.size() < kHeaderSize + sizeof(std::uint32_t)) {
    return fail(ErrorCode::kBadFormat, "{}: truncated STL, or STL as text; save it as binary STL",
                name);
  }
  ByteReader in(bytes.substr(kHeaderSize));
  const std::uint32_t count = *in.number<std::uint32_t>();
  if (in.rest().size() / kTriangleSize < count) {
    return fail(ErrorCode::kBadFormat,
                "{}: truncated STL, or STL as text: should have {} triangles, has {}", name, count,
                in.rest().size() / kTriangleSize);
  }
  TriangleMesh mesh;
  Welder welder(mesh);
  for (std::uint32_t i = 0; i < count; ++i) {
    std::array<Vec3f, 4> vectors;  // normal and corners; the size check covers all twelve numbers
    for (Vec3f& vector : vectors) {
      for (int axis = 0; axis < 3; ++axis) vector[axis] = *in.number<float>();
    }
    (void)in.number<std::uint16_t>();
    if (!vectors[1].allFinite() || !vectors[2].allFinite() || !vectors[3].allFinite()) {
      return fail(ErrorCode::kBadFormat, "{}: triangle {} has a coordinate that is not a number",
                  name, i);
    }
    mesh.triangles.push_back(
        {welder.index_of(vectors[1]), welder.index_of(vectors[2]), welder.index_of(vectors[3])});
  }
  compute_vertex_normals(mesh);
  return mesh;
}

Result<TriangleMesh> read_stl(const std::filesystem::path& path) {
  return read_file(path).and_then(
      [&](const std::string& bytes) { return parse_stl(bytes, path.string()); });
}

Result<void> write_stl(const std::filesystem::path& path, const TriangleMesh& mesh) {
  if (mesh.triangles.size() > std::numeric_limits<std::uint32_t>::max()) {
    return fail(ErrorCode::kBadOption, "{}: {} triangles are too many for STL; write .ply instead",
                path.string(), mesh.triangles.size());
  }
  Result<ByteWriter> out = ByteWriter::create(path);
  if (!out) return tl::unexpected(out.error());
  // Must not start with "solid", which marks STL as text.
  std::string header = "flytri binary STL, millimeters";
  header.resize(kHeaderSize, ' ');
  out->text(header);
  out->number(static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const Triangle& triangle : mesh.triangles) {
    const auto corner = [&](int i) { return mesh.vertices[triangle[i]].position_mm; };
    put_vector(*out, triangle_normal(corner(0), corner(1), corner(2)));
    for (int i = 0; i < 3; ++i) put_vector(*out, corner(i));
    out->number(std::uint16_t{0});
  }
  return out->commit();
}

}  // namespace flytri::io
