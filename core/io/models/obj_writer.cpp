#include <utility>
#include <vector>

#include "core/io/files/byte_stream.h"
#include "core/io/files/png.h"
#include "core/io/models/obj.h"

namespace flytri::io {
namespace {

/// With enough digits to read the same float again.
void put_floats(ByteWriter& out, std::string_view keyword, const float* values, int count) {
  out.text(keyword);
  for (int i = 0; i < count; ++i) out.text(fmt::format(" {}", values[i]));
}

void put_vertices(ByteWriter& out, const TexturedMesh& model) {
  for (const SurfacePoint& point : model.mesh.vertices) {
    put_floats(out, "v", point.position_mm.data(), 3);
    if (model.atlas.empty()) {
      for (const std::uint8_t channel : point.color)
        out.text(fmt::format(" {:.4f}", channel / 255.0));
    }
    out.text("\n");
  }
  for (const Eigen::Vector2f& uv : model.uv) {
    // OBJ counts upwards from the lower edge of the image.
    const Eigen::Vector2f turned(uv.x(), 1.0F - uv.y());
    put_floats(out, "vt", turned.data(), 2);
    out.text("\n");
  }
  for (const SurfacePoint& point : model.mesh.vertices) {
    put_floats(out, "vn", point.normal.data(), 3);
    out.text("\n");
  }
}

void put_faces(ByteWriter& out, const TexturedMesh& model) {
  for (const Triangle& triangle : model.mesh.triangles) {
    out.text("f");
    for (const std::uint32_t vertex : triangle) {
      const std::uint64_t number = std::uint64_t{vertex} + 1;
      out.text(model.uv.empty() ? fmt::format(" {0}//{0}", number)
                                : fmt::format(" {0}/{0}/{0}", number));
    }
    out.text("\n");
  }
}

std::filesystem::path image_of(std::filesystem::path path) {
  return path.replace_extension(".png");
}
std::filesystem::path materials_of(std::filesystem::path path) {
  return path.replace_extension(".mtl");
}

/// Adds a file with these bytes, which does not have its name yet.
Result<void> prepare_file(const std::filesystem::path& path, std::string_view bytes,
                          std::vector<AtomicFile>& files) {
  Result<AtomicFile> file = AtomicFile::create(path, Access::kOwnerOnly);
  if (!file) return tl::unexpected(file.error());
  if (Result<void> written = file->write(bytes); !written) return written;
  files.push_back(*std::move(file));
  return {};
}

/// Adds the texture, and the material that refers to it.
Result<void> prepare_texture(const std::filesystem::path& path, const cv::Mat& atlas,
                             std::vector<AtomicFile>& files) {
  const Result<std::string> png = encode_png(atlas);
  if (!png) return tl::unexpected(png.error());
  const std::string material =
      fmt::format("# flytri\nnewmtl surface\nKa 0 0 0\nKd 1 1 1\nKs 0 0 0\nillum 1\nmap_Kd {}\n",
                  image_of(path).filename().string());
  return prepare_file(image_of(path), *png, files).and_then([&] {
    return prepare_file(materials_of(path), material, files);
  });
}

Result<AtomicFile> prepare_surface(const std::filesystem::path& path, const TexturedMesh& model) {
  Result<ByteWriter> out = ByteWriter::create(path);
  if (!out) return tl::unexpected(out.error());
  out->text("# flytri, millimeters\n");
  if (!model.atlas.empty()) {
    out->text(fmt::format("mtllib {}\nusemtl surface\n", materials_of(path).filename().string()));
  }
  put_vertices(*out, model);
  put_faces(*out, model);
  return out->finish();
}

}  // namespace

Result<void> write_obj(const std::filesystem::path& path, const TexturedMesh& model) {
  std::vector<AtomicFile> files;
  if (!model.atlas.empty()) {
    if (Result<void> texture = prepare_texture(path, model.atlas, files); !texture) return texture;
  }
  Result<AtomicFile> surface = prepare_surface(path, model);
  if (!surface) return tl::unexpected(surface.error());
  files.push_back(*std::move(surface));
  return commit_together(std::move(files));
}

}  // namespace flytri::io
