#include <tiny_gltf.h>

#include <cstring>
#include <limits>
#include <optional>

#include "core/interchange/glb.h"
#include "core/interchange/glb_color.h"
#include "core/interchange/png.h"

namespace flytri {
namespace {

/// Keeps an embedded image as it is; the project's own decoder follows later.
bool keep_image(tinygltf::Image* image, int, std::string*, std::string*, int, int,
                const unsigned char* bytes, int size, void*) {
  image->image.assign(bytes, bytes + size);
  return true;
}

/// A .glb has all it needs inside: no name in it may open another file.
tinygltf::FsCallbacks no_files() {
  tinygltf::FsCallbacks callbacks{};
  callbacks.FileExists = [](const std::string&, void*) { return false; };
  callbacks.ExpandFilePath = [](const std::string&, void*) { return std::string(); };
  callbacks.ReadWholeFile = [](std::vector<unsigned char>*, std::string*, const std::string&,
                               void*) { return false; };
  callbacks.WriteWholeFile = [](std::string*, const std::string&, const std::vector<unsigned char>&,
                                void*) { return false; };
  return callbacks;
}

std::optional<tinygltf::Model> load(std::string_view bytes) {
  if (bytes.size() > std::numeric_limits<std::uint32_t>::max()) return std::nullopt;
  tinygltf::TinyGLTF loader;
  loader.SetImageLoader(keep_image, nullptr);
  loader.SetFsCallbacks(no_files());
  tinygltf::Model gltf;
  std::string error, warning;
  try {
    if (!loader.LoadBinaryFromMemory(&gltf, &error, &warning,
                                     reinterpret_cast<const unsigned char*>(bytes.data()),
                                     static_cast<unsigned int>(bytes.size()))) {
      return std::nullopt;
    }
  } catch (const std::exception&) {
    return std::nullopt;
  }
  return gltf;
}

template <typename T>
const T* element(const std::vector<T>& list, int index) {
  return index >= 0 && static_cast<std::size_t>(index) < list.size() ? &list[index] : nullptr;
}

/// Copies the numbers of an accessor out; nothing if it is not of that form or leaves its buffer.
template <typename T>
std::optional<std::vector<T>> numbers(const tinygltf::Model& gltf, int index, int component,
                                      int type) {
  const tinygltf::Accessor* accessor = element(gltf.accessors, index);
  if (accessor == nullptr || accessor->componentType != component || accessor->type != type ||
      accessor->sparse.isSparse) {
    return std::nullopt;
  }
  const tinygltf::BufferView* view = element(gltf.bufferViews, accessor->bufferView);
  const tinygltf::Buffer* buffer = view ? element(gltf.buffers, view->buffer) : nullptr;
  const auto width = static_cast<std::size_t>(tinygltf::GetNumComponentsInType(type));
  const std::size_t item = width * sizeof(T);
  if (buffer == nullptr || (view->byteStride != 0 && view->byteStride != item) ||
      view->byteOffset > buffer->data.size() ||
      view->byteLength > buffer->data.size() - view->byteOffset ||
      accessor->byteOffset > view->byteLength ||
      accessor->count > (view->byteLength - accessor->byteOffset) / item) {
    return std::nullopt;
  }
  std::vector<T> values(accessor->count * width);
  if (!values.empty()) {
    std::memcpy(values.data(), buffer->data.data() + view->byteOffset + accessor->byteOffset,
                accessor->count * item);
  }
  return values;
}

int attribute(const tinygltf::Primitive& primitive, const char* name) {
  const auto found = primitive.attributes.find(name);
  return found == primitive.attributes.end() ? -1 : found->second;
}

bool is_our_root(const tinygltf::Node& node) {
  return node.scale == std::vector<double>{0.001, 0.001, 0.001} &&
         node.rotation == std::vector<double>{1.0, 0.0, 0.0, 0.0} && node.translation.empty() &&
         node.matrix.empty();
}

const tinygltf::Primitive* our_primitive(const tinygltf::Model& gltf) {
  const tinygltf::Node* node = element(gltf.nodes, 0);
  const tinygltf::Mesh* mesh =
      node && is_our_root(*node) ? element(gltf.meshes, node->mesh) : nullptr;
  return mesh ? element(mesh->primitives, 0) : nullptr;
}

bool read_vertices(const tinygltf::Model& gltf, const tinygltf::Primitive& primitive,
                   std::vector<SurfacePoint>& vertices) {
  constexpr int kFloat = TINYGLTF_COMPONENT_TYPE_FLOAT;
  const auto positions =
      numbers<float>(gltf, attribute(primitive, "POSITION"), kFloat, TINYGLTF_TYPE_VEC3);
  const auto normals =
      numbers<float>(gltf, attribute(primitive, "NORMAL"), kFloat, TINYGLTF_TYPE_VEC3);
  if (!positions || !normals || positions->size() != normals->size()) return false;
  vertices.resize(positions->size() / 3);
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    vertices[i].position_mm = Eigen::Map<const Vec3f>(&(*positions)[3 * i]);
    vertices[i].normal = Eigen::Map<const Vec3f>(&(*normals)[3 * i]);
    if (!vertices[i].position_mm.allFinite() || !vertices[i].normal.allFinite()) return false;
  }
  return true;
}

bool read_colors(const tinygltf::Model& gltf, int accessor, std::vector<SurfacePoint>& vertices) {
  if (accessor < 0) return true;
  const auto light = numbers<std::uint16_t>(gltf, accessor, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT,
                                            TINYGLTF_TYPE_VEC4);
  if (!light || light->size() != 4 * vertices.size()) return false;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) vertices[i].color[c] = to_srgb((*light)[4 * i + c]);
  }
  return true;
}

bool read_uv(const tinygltf::Model& gltf, int accessor, TexturedMesh& model) {
  if (accessor < 0) return true;
  const auto uv = numbers<float>(gltf, accessor, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC2);
  if (!uv || uv->size() != 2 * model.mesh.vertices.size()) return false;
  for (std::size_t i = 0; i < uv->size(); i += 2) model.uv.emplace_back((*uv)[i], (*uv)[i + 1]);
  return true;
}

bool read_triangles(const tinygltf::Model& gltf, int accessor, TriangleMesh& mesh) {
  const auto indices = numbers<std::uint32_t>(gltf, accessor, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT,
                                              TINYGLTF_TYPE_SCALAR);
  if (!indices || indices->size() % 3 != 0) return false;
  for (std::size_t i = 0; i < indices->size(); i += 3) {
    mesh.triangles.push_back({(*indices)[i], (*indices)[i + 1], (*indices)[i + 2]});
    for (const std::uint32_t vertex : mesh.triangles.back()) {
      if (vertex >= mesh.vertices.size()) return false;
    }
  }
  return true;
}

}  // namespace

Result<TexturedMesh> parse_glb(std::string_view bytes, const std::string& name) {
  const std::optional<tinygltf::Model> gltf = load(bytes);
  if (!gltf) return fail(ErrorCode::kBadFormat, "{}: not a binary glTF file, or truncated", name);
  const tinygltf::Primitive* primitive = our_primitive(*gltf);
  TexturedMesh model;
  if (primitive == nullptr || !read_vertices(*gltf, *primitive, model.mesh.vertices) ||
      !read_colors(*gltf, attribute(*primitive, "COLOR_0"), model.mesh.vertices) ||
      !read_uv(*gltf, attribute(*primitive, "TEXCOORD_0"), model) ||
      !read_triangles(*gltf, primitive->indices, model.mesh)) {
    return fail(ErrorCode::kBadFormat,
                "{}: damaged, or not built as this program builds .glb; convert it to .ply", name);
  }
  if (gltf->images.empty()) return model;
  const std::vector<unsigned char>& png = gltf->images.front().image;
  Result<cv::Mat> atlas =
      decode_png({reinterpret_cast<const char*>(png.data()), png.size()}, name + " (atlas)");
  if (!atlas) return tl::unexpected(atlas.error());
  model.atlas = *std::move(atlas);
  return model;
}

}  // namespace flytri
