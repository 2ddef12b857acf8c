#include <tiny_gltf.h>

#include <array>
#include <limits>
#include <sstream>

#include "core/imaging/srgb.h"
#include "core/io/files/file_bytes.h"
#include "core/io/files/png.h"
#include "core/io/models/glb.h"

namespace flytri::io {
namespace {

/// Builds a glTF document with one buffer.
class GlbBuilder {
 public:
  explicit GlbBuilder(const TriangleMesh& mesh) : mesh_(mesh) {
    gltf_.asset.version = "2.0";
    gltf_.asset.generator = "flytri";
    gltf_.buffers.emplace_back();
    primitive_.mode = TINYGLTF_MODE_TRIANGLES;
    primitive_.material = 0;
  }

  void add_positions() {
    const int accessor = begin_accessor(TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3,
                                        mesh_.vertices.size(), TINYGLTF_TARGET_ARRAY_BUFFER);
    Vec3f low = mesh_.vertices.front().position_mm, high = low;
    for (const SurfacePoint& point : mesh_.vertices) {
      put(point.position_mm.data(), 3);
      low = low.cwiseMin(point.position_mm);
      high = high.cwiseMax(point.position_mm);
    }
    gltf_.accessors[static_cast<std::size_t>(accessor)].minValues = {low.x(), low.y(), low.z()};
    gltf_.accessors[static_cast<std::size_t>(accessor)].maxValues = {high.x(), high.y(), high.z()};
    end_view();
    primitive_.attributes["POSITION"] = accessor;
  }
  void add_normals() {
    primitive_.attributes["NORMAL"] =
        begin_accessor(TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3, mesh_.vertices.size(),
                       TINYGLTF_TARGET_ARRAY_BUFFER);
    for (const SurfacePoint& point : mesh_.vertices) {
      const float length = point.normal.norm();
      const Vec3f unit = length > 0.0F ? Vec3f(point.normal / length) : Vec3f::UnitZ();
      put(unit.data(), 3);
    }
    end_view();
  }
  void add_uv(const std::vector<Eigen::Vector2f>& uv) {
    primitive_.attributes["TEXCOORD_0"] = begin_accessor(
        TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC2, uv.size(), TINYGLTF_TARGET_ARRAY_BUFFER);
    for (const Eigen::Vector2f& place : uv) put(place.data(), 2);
    end_view();
  }
  void add_colors() {
    // Four components, as each vertex must start at a multiple of four bytes; the last is opaque.
    primitive_.attributes["COLOR_0"] =
        begin_accessor(TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, TINYGLTF_TYPE_VEC4,
                       mesh_.vertices.size(), TINYGLTF_TARGET_ARRAY_BUFFER);
    gltf_.accessors.back().normalized = true;
    for (const SurfacePoint& point : mesh_.vertices) {
      const std::array<std::uint16_t, 4> light = {
          to_linear(point.color[0]), to_linear(point.color[1]), to_linear(point.color[2]), 65535};
      put(light.data(), light.size());
    }
    end_view();
  }
  /// An attribute of flytri: other programs ignore it, as glTF requires.
  void add_sigma() {
    primitive_.attributes["_SIGMA"] =
        begin_accessor(TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_SCALAR, mesh_.vertices.size(),
                       TINYGLTF_TARGET_ARRAY_BUFFER);
    for (const SurfacePoint& point : mesh_.vertices) put(&point.sigma_mm, 1);
    end_view();
  }
  void add_triangles() {
    primitive_.indices =
        begin_accessor(TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TYPE_SCALAR,
                       3 * mesh_.triangles.size(), TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
    for (const Triangle& triangle : mesh_.triangles) put(triangle.data(), 3);
    end_view();
  }
  void add_material() {
    tinygltf::Material material;
    // Teeth and plaster: not metal, slightly glossy.
    material.pbrMetallicRoughness.metallicFactor = 0.0;
    material.pbrMetallicRoughness.roughnessFactor = 0.7;
    if (!gltf_.textures.empty()) material.pbrMetallicRoughness.baseColorTexture.index = 0;
    gltf_.materials.push_back(material);
  }
  void add_atlas(const std::string& png) {
    begin_view(0);
    put(png.data(), png.size());
    end_view();
    tinygltf::Image image;
    image.bufferView = static_cast<int>(gltf_.bufferViews.size()) - 1;
    image.mimeType = "image/png";
    gltf_.images.push_back(image);
    tinygltf::Sampler sampler;
    sampler.magFilter = TINYGLTF_TEXTURE_FILTER_LINEAR;
    sampler.minFilter = TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_LINEAR;
    sampler.wrapS = sampler.wrapT = TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
    gltf_.samplers.push_back(sampler);
    tinygltf::Texture texture;
    texture.source = texture.sampler = 0;
    gltf_.textures.push_back(texture);
  }
  tinygltf::Model finish() {
    tinygltf::Mesh mesh;
    mesh.primitives.push_back(primitive_);
    gltf_.meshes.push_back(mesh);
    tinygltf::Node node;
    node.mesh = 0;
    node.rotation = {1.0, 0.0, 0.0, 0.0};  // x, y, z, w: half a turn about x
    node.scale = {0.001, 0.001, 0.001};    // millimeters to meters
    gltf_.nodes.push_back(node);
    gltf_.scenes.emplace_back().nodes = {0};
    gltf_.defaultScene = 0;
    return std::move(gltf_);
  }

 private:
  std::vector<unsigned char>& bytes() { return gltf_.buffers.front().data; }

  void begin_view(int target) {
    bytes().resize((bytes().size() + 3) / 4 * 4);
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = bytes().size();
    view.target = target;
    gltf_.bufferViews.push_back(view);
  }
  void end_view() {
    gltf_.bufferViews.back().byteLength = bytes().size() - gltf_.bufferViews.back().byteOffset;
  }
  int begin_accessor(int component, int type, std::size_t count, int target) {
    begin_view(target);
    tinygltf::Accessor accessor;
    accessor.bufferView = static_cast<int>(gltf_.bufferViews.size()) - 1;
    accessor.componentType = component;
    accessor.type = type;
    accessor.count = count;
    gltf_.accessors.push_back(accessor);
    return static_cast<int>(gltf_.accessors.size()) - 1;
  }
  template <typename T>
  void put(const T* values, std::size_t count) {
    const auto* first = reinterpret_cast<const unsigned char*>(values);
    bytes().insert(bytes().end(), first, first + count * sizeof(T));
  }

  const TriangleMesh& mesh_;
  tinygltf::Model gltf_;
  tinygltf::Primitive primitive_;
};

std::string serialize(tinygltf::Model& gltf) {
  std::ostringstream stream;
  tinygltf::TinyGLTF writer;
  const bool written = writer.WriteGltfSceneToStream(&gltf, stream, false, true);
  return written ? std::move(stream).str() : std::string();
}

}  // namespace

Result<std::string> encode_glb(const TexturedMesh& model, const std::string& name) {
  const bool is_textured = !model.atlas.empty();
  std::string png;
  if (is_textured) {
    Result<std::string> encoded = encode_png(model.atlas);
    if (!encoded) return encoded;
    png = *std::move(encoded);
  }
  // At most 52 bytes per vertex; the JSON text is much smaller than the reserve.
  constexpr std::uint64_t kReserve = 1U << 20U;
  const std::uint64_t size =
      52 * model.mesh.vertices.size() + 12 * model.mesh.triangles.size() + png.size() + kReserve;
  if (size > std::numeric_limits<std::uint32_t>::max()) {
    return fail(ErrorCode::kBadOption,
                "{}: too large: glTF holds at most 4 GiB; write .ply instead", name);
  }
  GlbBuilder builder(model.mesh);
  builder.add_positions();
  builder.add_normals();
  if (is_textured) {
    builder.add_uv(model.uv);
  } else {
    builder.add_colors();
  }
  builder.add_sigma();
  builder.add_triangles();
  if (is_textured) builder.add_atlas(png);
  builder.add_material();
  tinygltf::Model gltf = builder.finish();
  std::string bytes = serialize(gltf);
  if (bytes.empty())
    return fail(ErrorCode::kWriteFailed, "{}: cannot be written as glTF; write .ply instead", name);
  return bytes;
}

Result<void> write_glb(const std::filesystem::path& path, const TexturedMesh& model) {
  return encode_glb(model, path.string()).and_then([&](const std::string& bytes) {
    return write_file(path, bytes, Access::kOwnerOnly);
  });
}

}  // namespace flytri::io
