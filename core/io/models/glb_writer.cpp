#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>
#include <vector>

#include "core/imaging/srgb.h"
#include "core/io/files/file_bytes.h"
#include "core/io/files/png.h"
#include "core/io/models/glb.h"

namespace flytri::io {
namespace {

/// Builds a glTF document with one buffer.
class GlbBuilder {
 public:
  explicit GlbBuilder(GlbAxes axes) : axes_(axes) {
    gltf_.asset.version = "2.0";
    gltf_.asset.generator = "flytri";
    gltf_.buffers.emplace_back();
    gltf_.scenes.emplace_back();
    gltf_.defaultScene = 0;
  }

  /// @param png  of the atlas; empty: colors of the vertices
  void add_model(const NamedModel& named, const std::string& png) {
    const TriangleMesh& mesh = named.model->mesh;
    primitive_ = {};
    primitive_.mode = TINYGLTF_MODE_TRIANGLES;
    add_positions(mesh);
    add_normals(mesh);
    if (png.empty()) {
      add_colors(mesh);
    } else {
      add_uv(named.model->uv);
    }
    add_sigma(mesh);
    add_triangles(mesh);
    if (!png.empty()) add_atlas(png);
    add_material(!png.empty());
    add_node(named.name);
  }
  tinygltf::Model finish() { return std::move(gltf_); }

 private:
  void add_positions(const TriangleMesh& mesh) {
    const int accessor = begin_accessor(TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3,
                                        mesh.vertices.size(), TINYGLTF_TARGET_ARRAY_BUFFER);
    Vec3f low = mesh.vertices.front().position_mm, high = low;
    for (const SurfacePoint& point : mesh.vertices) {
      put(point.position_mm.data(), 3);
      low = low.cwiseMin(point.position_mm);
      high = high.cwiseMax(point.position_mm);
    }
    gltf_.accessors[static_cast<std::size_t>(accessor)].minValues = {low.x(), low.y(), low.z()};
    gltf_.accessors[static_cast<std::size_t>(accessor)].maxValues = {high.x(), high.y(), high.z()};
    end_view();
    primitive_.attributes["POSITION"] = accessor;
  }
  void add_normals(const TriangleMesh& mesh) {
    primitive_.attributes["NORMAL"] =
        begin_accessor(TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3, mesh.vertices.size(),
                       TINYGLTF_TARGET_ARRAY_BUFFER);
    for (const SurfacePoint& point : mesh.vertices) {
      // What was written and read stays as it is, to the bit.
      constexpr float kUnit = 1e-5F;
      const float length = point.normal.norm();
      const Vec3f unit = std::abs(length - 1.0F) < kUnit ? point.normal
                         : length > 0.0F                 ? Vec3f(point.normal / length)
                                                         : Vec3f::UnitZ();
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
  void add_colors(const TriangleMesh& mesh) {
    // Four components, as each vertex must start at a multiple of four bytes; the last is opaque.
    primitive_.attributes["COLOR_0"] =
        begin_accessor(TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, TINYGLTF_TYPE_VEC4,
                       mesh.vertices.size(), TINYGLTF_TARGET_ARRAY_BUFFER);
    gltf_.accessors.back().normalized = true;
    for (const SurfacePoint& point : mesh.vertices) {
      const std::array<std::uint16_t, 4> light = {
          to_linear(point.color[0]), to_linear(point.color[1]), to_linear(point.color[2]), 65535};
      put(light.data(), light.size());
    }
    end_view();
  }
  /// Attributes of flytri: other programs ignore them, as glTF requires. What was not measured has
  /// no uncertainty that a file could hold.
  void add_sigma(const TriangleMesh& mesh) {
    const auto add = [&](const char* name, const auto& value_of) {
      primitive_.attributes[name] =
          begin_accessor(TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_SCALAR, mesh.vertices.size(),
                         TINYGLTF_TARGET_ARRAY_BUFFER);
      for (const SurfacePoint& point : mesh.vertices) {
        const float value = value_of(point);
        put(&value, 1);
      }
      end_view();
    };
    const auto is_measured = [](const SurfacePoint& point) { return !std::isinf(point.sigma_mm); };
    add("_SIGMA",
        [&](const SurfacePoint& point) { return is_measured(point) ? point.sigma_mm : 0.0F; });
    if (std::all_of(mesh.vertices.begin(), mesh.vertices.end(), is_measured)) return;
    add("_MEASURED", [&](const SurfacePoint& point) { return is_measured(point) ? 1.0F : 0.0F; });
  }
  void add_triangles(const TriangleMesh& mesh) {
    primitive_.indices =
        begin_accessor(TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TYPE_SCALAR,
                       3 * mesh.triangles.size(), TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
    for (const Triangle& triangle : mesh.triangles) put(triangle.data(), 3);
    end_view();
  }
  void add_material(bool is_textured) {
    tinygltf::Material material;
    // Teeth and plaster: not metal, slightly glossy.
    material.pbrMetallicRoughness.metallicFactor = 0.0;
    material.pbrMetallicRoughness.roughnessFactor = 0.7;
    if (is_textured) {
      material.pbrMetallicRoughness.baseColorTexture.index =
          static_cast<int>(gltf_.textures.size()) - 1;
    }
    primitive_.material = static_cast<int>(gltf_.materials.size());
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
    if (gltf_.samplers.empty()) add_sampler();
    tinygltf::Texture texture;
    texture.source = static_cast<int>(gltf_.images.size()) - 1;
    texture.sampler = 0;
    gltf_.textures.push_back(texture);
  }
  void add_sampler() {
    tinygltf::Sampler sampler;
    sampler.magFilter = TINYGLTF_TEXTURE_FILTER_LINEAR;
    sampler.minFilter = TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_LINEAR;
    sampler.wrapS = sampler.wrapT = TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
    gltf_.samplers.push_back(sampler);
  }
  void add_node(const std::string& name) {
    constexpr double kHalfRoot = 0.70710678118654752;
    tinygltf::Mesh mesh;
    mesh.primitives.push_back(primitive_);
    mesh.name = name;
    tinygltf::Node node;
    node.mesh = static_cast<int>(gltf_.meshes.size());
    node.name = name;
    // x, y, z, w
    node.rotation = axes_ == GlbAxes::kSensor ? std::vector{1.0, 0.0, 0.0, 0.0}
                                              : std::vector{-kHalfRoot, 0.0, 0.0, kHalfRoot};
    node.scale = {0.001, 0.001, 0.001};  // millimeters to meters
    gltf_.meshes.push_back(mesh);
    gltf_.scenes.front().nodes.push_back(static_cast<int>(gltf_.nodes.size()));
    gltf_.nodes.push_back(node);
  }

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

  GlbAxes axes_;
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
  return encode_glb_scene(std::array{NamedModel{"", &model}}, name);
}

Result<std::string> encode_glb_scene(std::span<const NamedModel> models, const std::string& name,
                                     GlbAxes axes) {
  // At most 52 bytes per vertex; the JSON text is much smaller than the reserve.
  constexpr std::uint64_t kReserve = 1U << 20U;
  std::uint64_t size = kReserve;
  std::vector<std::string> pngs;
  for (const NamedModel& named : models) {
    const TexturedMesh& model = *named.model;
    pngs.emplace_back();
    if (!model.atlas.empty()) {
      Result<std::string> encoded = encode_png(model.atlas);
      if (!encoded) return encoded;
      pngs.back() = *std::move(encoded);
    }
    size += 52 * model.mesh.vertices.size() + 12 * model.mesh.triangles.size() + pngs.back().size();
  }
  if (size > std::numeric_limits<std::uint32_t>::max()) {
    return fail(ErrorCode::kBadOption,
                "{}: too large: glTF holds at most 4 GiB; write .ply instead", name);
  }
  GlbBuilder builder(axes);
  for (std::size_t i = 0; i < models.size(); ++i) builder.add_model(models[i], pngs[i]);
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
