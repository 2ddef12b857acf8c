#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>

#include "core/geometry/mesh_normals.h"
#include "core/io/files/byte_stream.h"
#include "core/io/models/ply.h"
#include "core/io/models/ply_header.h"

namespace flytri::io {
namespace {

/// Reads the numbers after the header one by one, from binary data or text.
class NumberSource {
 public:
  NumberSource(std::string_view bytes, bool is_binary) : bytes_(bytes), is_binary_(is_binary) {}

  std::optional<double> next(PlyScalar type) { return is_binary_ ? binary(type) : text(); }

 private:
  template <typename T>
  std::optional<double> take() {
    const std::optional<T> value = bytes_.number<T>();
    return value ? std::optional<double>(static_cast<double>(*value)) : std::nullopt;
  }
  std::optional<double> binary(PlyScalar type) {
    switch (type) {
      case PlyScalar::kInt8:
        return take<std::int8_t>();
      case PlyScalar::kUint8:
        return take<std::uint8_t>();
      case PlyScalar::kInt16:
        return take<std::int16_t>();
      case PlyScalar::kUint16:
        return take<std::uint16_t>();
      case PlyScalar::kInt32:
        return take<std::int32_t>();
      case PlyScalar::kUint32:
        return take<std::uint32_t>();
      case PlyScalar::kFloat:
        return take<float>();
      case PlyScalar::kDouble:
        return take<double>();
    }
    return std::nullopt;
  }
  std::optional<double> text() {
    std::string_view rest = bytes_.rest();
    const std::size_t start = rest.find_first_not_of(" \t\r\n");
    if (start == std::string_view::npos) return std::nullopt;
    rest.remove_prefix(start);
    double value = 0.0;
    const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), value);
    if (error != std::errc()) return std::nullopt;
    bytes_ = ByteReader(rest.substr(static_cast<std::size_t>(end - rest.data())));
    return value;
  }

  ByteReader bytes_;
  bool is_binary_;
};

std::uint8_t to_channel(double value, PlyScalar type) {
  const bool is_share = type == PlyScalar::kFloat || type == PlyScalar::kDouble;
  const double scaled = is_share ? 255.0 * value : value;
  if (!(scaled > 0.0)) return 0;
  return static_cast<std::uint8_t>(std::lround(std::min(scaled, 255.0)));
}

/// Sets the property of this name; false: SurfacePoint has none.
bool set_property(SurfacePoint& point, const PlyProperty& property, double value) {
  static constexpr std::array<std::string_view, 3> kPosition = {"x", "y", "z"};
  static constexpr std::array<std::string_view, 3> kNormal = {"nx", "ny", "nz"};
  static constexpr std::array<std::string_view, 3> kColor = {"red", "green", "blue"};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    if (property.name == kPosition[i])
      point.position_mm[axis] = static_cast<float>(value);
    else if (property.name == kNormal[i])
      point.normal[axis] = static_cast<float>(value);
    else if (property.name == kColor[i])
      point.color[i] = to_channel(value, property.type);
    else
      continue;
    return true;
  }
  // Written after sigma.
  if (property.name == "measured") {
    if (value == 0.0) point.sigma_mm = std::numeric_limits<float>::infinity();
    return true;
  }
  if (property.name != "sigma") return false;
  point.sigma_mm = static_cast<float>(value);
  return true;
}

bool has_property(const PlyElement& element, std::string_view name) {
  for (const PlyProperty& property : element.properties) {
    if (property.name == name && !property.is_list) return true;
  }
  return false;
}

/// The length of a list; nothing if the number cannot be a length.
std::optional<std::uint32_t> next_count(NumberSource& source, const PlyProperty& property) {
  const std::optional<double> count = source.next(property.count_type);
  constexpr double kLargest = std::numeric_limits<std::uint32_t>::max();
  if (!count || !(*count >= 0.0 && *count <= kLargest)) return std::nullopt;
  return static_cast<std::uint32_t>(*count);
}

bool skip_list(NumberSource& source, const PlyProperty& property) {
  const std::optional<std::uint32_t> count = next_count(source, property);
  if (!count) return false;
  for (std::uint32_t i = 0; i < *count; ++i) {
    if (!source.next(property.type)) return false;
  }
  return true;
}

bool read_vertices(NumberSource& source, const PlyElement& element, PlyMesh& out) {
  out.mesh.vertices.resize(element.count);
  for (SurfacePoint& point : out.mesh.vertices) {
    for (const PlyProperty& property : element.properties) {
      if (property.is_list) {
        if (!skip_list(source, property)) return false;
        continue;
      }
      const std::optional<double> value = source.next(property.type);
      if (!value) return false;
      if (!set_property(point, property, *value)) out.extra[property.name].push_back(*value);
    }
  }
  return true;
}

/// Reads a polygon as a fan of triangles around its first corner.
bool read_polygon(NumberSource& source, const PlyProperty& property, std::vector<Triangle>& out) {
  const std::optional<std::uint32_t> count = next_count(source, property);
  if (!count) return false;
  std::array<std::uint32_t, 2> fan{};  // first corner, latest corner
  for (std::uint32_t i = 0; i < *count; ++i) {
    const std::optional<double> value = source.next(property.type);
    constexpr double kLargest = std::numeric_limits<std::uint32_t>::max();
    if (!value || !(*value >= 0.0 && *value <= kLargest)) return false;
    const auto corner = static_cast<std::uint32_t>(*value);
    if (i == 0) fan[0] = corner;
    if (i >= 2) out.push_back({fan[0], fan[1], corner});
    fan[1] = corner;
  }
  return true;
}

bool read_faces(NumberSource& source, const PlyElement& element, std::vector<Triangle>& out) {
  for (std::uint64_t i = 0; i < element.count; ++i) {
    for (const PlyProperty& property : element.properties) {
      const bool is_polygon = property.is_list && (property.name == "vertex_indices" ||
                                                   property.name == "vertex_index");
      const bool read = is_polygon         ? read_polygon(source, property, out)
                        : property.is_list ? skip_list(source, property)
                                           : source.next(property.type).has_value();
      if (!read) return false;
    }
  }
  return true;
}

bool skip_element(NumberSource& source, const PlyElement& element) {
  std::vector<Triangle> nothing;
  return read_faces(source, element, nothing);
}

Result<void> check_mesh(const TriangleMesh& mesh, const std::string& name) {
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    if (!mesh.vertices[i].position_mm.allFinite() || !mesh.vertices[i].normal.allFinite()) {
      return fail(ErrorCode::kBadFormat, "{}: vertex {} has a coordinate that is not a number",
                  name, i);
    }
  }
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    for (const std::uint32_t vertex : mesh.triangles[i]) {
      if (vertex >= mesh.vertices.size()) {
        return fail(ErrorCode::kBadFormat,
                    "{}: a face refers to vertex {}, but there are only {} vertices", name, vertex,
                    mesh.vertices.size());
      }
    }
  }
  return {};
}

}  // namespace

Result<PlyMesh> parse_ply(std::string_view bytes, const std::string& name) {
  const Result<PlyHeader> header = parse_ply_header(bytes, name);
  if (!header) return tl::unexpected(header.error());
  NumberSource source(bytes.substr(header->size), header->is_binary);
  PlyMesh out;
  bool has_vertices = false, has_normals = false;
  for (const PlyElement& element : header->elements) {
    const bool is_vertex = element.name == "vertex" && !has_vertices;
    if (is_vertex) {
      has_vertices =
          has_property(element, "x") && has_property(element, "y") && has_property(element, "z");
      has_normals = has_property(element, "nx");
    }
    const bool read = is_vertex                ? read_vertices(source, element, out)
                      : element.name == "face" ? read_faces(source, element, out.mesh.triangles)
                                               : skip_element(source, element);
    if (!read) {
      return fail(ErrorCode::kBadFormat, "{}: truncated or damaged PLY at element \"{}\"", name,
                  element.name);
    }
  }
  if (!has_vertices) {
    return fail(ErrorCode::kBadFormat, "{}: no element \"vertex\" with x, y and z", name);
  }
  if (Result<void> fine = check_mesh(out.mesh, name); !fine) return tl::unexpected(fine.error());
  if (!has_normals) compute_vertex_normals(out.mesh);
  return out;
}

Result<PlyMesh> read_ply(const std::filesystem::path& path) {
  return read_file(path).and_then(
      [&](const std::string& bytes) { return parse_ply(bytes, path.string()); });
}

}  // namespace flytri::io
