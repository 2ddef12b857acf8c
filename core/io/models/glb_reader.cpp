#include <cstring>
#include <limits>
#include <optional>

#include "core/imaging/srgb.h"
#include "core/io/files/byte_stream.h"
#include "core/io/files/file_bytes.h"
#include "core/io/files/json_place.h"
#include "core/io/files/png.h"
#include "core/io/models/check_texture.h"
#include "core/io/models/glb.h"

// Does not use tinygltf, which trusts the offsets in a file and may read beyond its end.

namespace flytri::io {
namespace {

constexpr std::uint32_t kGlbMagic = 0x46546C67, kGlbVersion = 2;             // "glTF"
constexpr std::uint32_t kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;  // "JSON", "BIN"
constexpr int kFloat = 5126, kUnsignedInt = 5125, kUnsignedShort = 5123;  // component types of glTF

/// Reads a chunk of the given type; nothing if the bytes do not contain it.
std::optional<std::string_view> take_chunk(ByteReader& in, std::uint32_t type) {
  const auto size = in.number<std::uint32_t>();
  const auto found = in.number<std::uint32_t>();
  if (!size || found != type || *size > in.rest().size()) return std::nullopt;
  const std::string_view chunk = in.rest().substr(0, *size);
  in = ByteReader(in.rest().substr(*size));
  return chunk;
}

struct Chunks {
  std::string_view json, binary;
};

std::optional<Chunks> split(std::string_view bytes) {
  ByteReader in(bytes);
  if (in.number<std::uint32_t>() != kGlbMagic || in.number<std::uint32_t>() != kGlbVersion ||
      in.number<std::uint32_t>() != bytes.size()) {
    return std::nullopt;
  }
  const auto json = take_chunk(in, kJsonChunk);
  const auto binary = json ? take_chunk(in, kBinaryChunk) : std::nullopt;
  if (!binary) return std::nullopt;
  return Chunks{*json, *binary};
}

/// The lists of a document, and the bytes that they refer to. Mismatches are recorded in the JSON.
class Document {
 public:
  Document(JsonPlace root, std::string_view binary)
      : root_(std::move(root)),
        views_(root_.at("bufferViews").elements()),
        accessors_(root_.at("accessors").elements()),
        binary_(binary) {}

  [[nodiscard]] const JsonPlace& root() const { return root_; }

  /// The bytes of the buffer view with this index.
  [[nodiscard]] std::string_view view(const JsonPlace& index) const {
    const auto at = static_cast<std::size_t>(index.whole_number());
    if (at >= views_.size()) {
      index.reject("the index of a buffer view");
      return {};
    }
    const std::size_t offset = count_of(views_[at], "byteOffset");
    const auto size = static_cast<std::size_t>(views_[at].at("byteLength").whole_number());
    if (offset > binary_.size() || size > binary_.size() - offset) {
      views_[at].reject("a part of the buffer");
      return {};
    }
    return binary_.substr(offset, size);
  }

  /// The numbers of the accessor with this index, which must have this form and no gaps.
  template <typename T>
  [[nodiscard]] std::vector<T> numbers(const JsonPlace& index, int component, std::string_view type,
                                       std::size_t width) const {
    const auto at = static_cast<std::size_t>(index.whole_number());
    if (at >= accessors_.size()) {
      index.reject("the index of an accessor");
      return {};
    }
    const JsonPlace& accessor = accessors_[at];
    if (accessor.at("componentType").whole_number() != component ||
        accessor.at("type").text() != type) {
      accessor.reject(fmt::format("{} of component type {}", type, component));
      return {};
    }
    const std::string_view bytes = view(accessor.at("bufferView"));
    const std::size_t offset = count_of(accessor, "byteOffset");
    const auto count = static_cast<std::size_t>(accessor.at("count").whole_number());
    if (offset > bytes.size() || count > (bytes.size() - offset) / (width * sizeof(T))) {
      accessor.reject("a part of its buffer view");
      return {};
    }
    std::vector<T> values(count * width);
    if (count > 0) std::memcpy(values.data(), bytes.data() + offset, values.size() * sizeof(T));
    return values;
  }

 private:
  static std::size_t count_of(const JsonPlace& place, std::string_view key) {
    return place.has(key) ? static_cast<std::size_t>(place.at(key).whole_number()) : 0;
  }

  JsonPlace root_;
  std::vector<JsonPlace> views_, accessors_;
  std::string_view binary_;
};

void expect_our_root(const JsonPlace& nodes) {
  const std::vector<JsonPlace> list = nodes.elements();
  if (list.size() != 1 || list[0].at("scale").numbers(3) != std::vector{0.001, 0.001, 0.001} ||
      list[0].at("rotation").numbers(4) != std::vector{1.0, 0.0, 0.0, 0.0}) {
    nodes.reject("the one node that flytri writes; convert models of other programs to .ply");
  }
}

void read_vertices(const Document& document, const JsonPlace& attributes,
                   std::vector<SurfacePoint>& vertices) {
  const auto positions = document.numbers<float>(attributes.at("POSITION"), kFloat, "VEC3", 3);
  const auto normals = document.numbers<float>(attributes.at("NORMAL"), kFloat, "VEC3", 3);
  if (positions.size() != normals.size()) {
    attributes.at("NORMAL").reject("as many normals as positions");
    return;
  }
  vertices.resize(positions.size() / 3);
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    vertices[i].position_mm = Eigen::Map<const Vec3f>(&positions[3 * i]);
    vertices[i].normal = Eigen::Map<const Vec3f>(&normals[3 * i]);
    if (!vertices[i].position_mm.allFinite() || !vertices[i].normal.allFinite()) {
      attributes.reject("finite positions and normals");
    }
  }
}

void read_colors(const Document& document, const JsonPlace& attributes,
                 std::vector<SurfacePoint>& vertices) {
  if (!attributes.has("COLOR_0")) return;
  const JsonPlace place = attributes.at("COLOR_0");
  const auto light = document.numbers<std::uint16_t>(place, kUnsignedShort, "VEC4", 4);
  if (light.size() != 4 * vertices.size()) {
    place.reject("as many colors as positions");
    return;
  }
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) vertices[i].color[c] = to_srgb(light[4 * i + c]);
  }
}

/// One number for each vertex; empty without the attribute.
std::vector<float> read_scalars(const Document& document, const JsonPlace& attributes,
                                const char* name, std::size_t count) {
  if (!attributes.has(name)) return {};
  const JsonPlace place = attributes.at(name);
  auto values = document.numbers<float>(place, kFloat, "SCALAR", 1);
  if (values.size() == count) return values;
  place.reject("as many values as positions");
  return {};
}

void read_sigma(const Document& document, const JsonPlace& attributes,
                std::vector<SurfacePoint>& vertices) {
  const auto sigma_mm = read_scalars(document, attributes, "_SIGMA", vertices.size());
  for (std::size_t i = 0; i < sigma_mm.size(); ++i) vertices[i].sigma_mm = sigma_mm[i];
  const auto measured = read_scalars(document, attributes, "_MEASURED", vertices.size());
  for (std::size_t i = 0; i < measured.size(); ++i) {
    if (measured[i] == 0.0F) vertices[i].sigma_mm = std::numeric_limits<float>::infinity();
  }
}

void read_uv(const Document& document, const JsonPlace& attributes, TexturedMesh& model) {
  if (!attributes.has("TEXCOORD_0")) return;
  const JsonPlace place = attributes.at("TEXCOORD_0");
  const auto uv = document.numbers<float>(place, kFloat, "VEC2", 2);
  if (uv.size() != 2 * model.mesh.vertices.size()) {
    place.reject("as many texture coordinates as positions");
    return;
  }
  for (std::size_t i = 0; i < uv.size(); i += 2) model.uv.emplace_back(uv[i], uv[i + 1]);
}

void read_triangles(const Document& document, const JsonPlace& place, TriangleMesh& mesh) {
  const auto indices = document.numbers<std::uint32_t>(place, kUnsignedInt, "SCALAR", 1);
  for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
    mesh.triangles.push_back({indices[i], indices[i + 1], indices[i + 2]});
    for (const std::uint32_t vertex : mesh.triangles.back()) {
      if (vertex >= mesh.vertices.size()) place.reject("indices of vertices");
    }
  }
}

/// Everything but the atlas.
TexturedMesh read_geometry(const Document& document) {
  TexturedMesh model;
  expect_our_root(document.root().at("nodes"));
  const std::vector<JsonPlace> meshes = document.root().at("meshes").elements();
  if (meshes.size() != 1) {
    document.root().at("meshes").reject("one mesh");
    return model;
  }
  const std::vector<JsonPlace> primitives = meshes[0].at("primitives").elements();
  if (primitives.size() != 1) {
    meshes[0].reject("one primitive");
    return model;
  }
  const JsonPlace attributes = primitives[0].at("attributes");
  read_vertices(document, attributes, model.mesh.vertices);
  read_colors(document, attributes, model.mesh.vertices);
  read_sigma(document, attributes, model.mesh.vertices);
  read_uv(document, attributes, model);
  read_triangles(document, primitives[0].at("indices"), model.mesh);
  return model;
}

}  // namespace

Result<TexturedMesh> parse_glb(std::string_view bytes, const std::string& name) {
  const std::optional<Chunks> chunks = split(bytes);
  if (!chunks) {
    return fail(ErrorCode::kBadFormat, "{}: is not a binary glTF 2.0 file, or is truncated", name);
  }
  Result<JsonPlace> json = JsonPlace::parse(chunks->json, name);
  if (!json) return tl::unexpected(json.error());
  const Document document(*std::move(json), chunks->binary);
  TexturedMesh model = read_geometry(document);
  std::string_view png;
  if (document.root().has("images")) {
    const std::vector<JsonPlace> images = document.root().at("images").elements();
    if (!images.empty()) png = document.view(images[0].at("bufferView"));
  }
  if (Result<void> outcome = document.root().outcome(); !outcome) {
    return tl::unexpected(outcome.error());
  }
  if (!png.empty()) {
    Result<cv::Mat> atlas = decode_png(png, name + " (atlas)");
    if (!atlas) return tl::unexpected(atlas.error());
    model.atlas = *std::move(atlas);
  }
  if (Result<void> good = check_texture(model, name); !good) return tl::unexpected(good.error());
  return model;
}

Result<TexturedMesh> read_glb(const std::filesystem::path& path) {
  return read_file(path).and_then(
      [&](const std::string& bytes) { return parse_glb(bytes, path.string()); });
}

}  // namespace flytri::io
