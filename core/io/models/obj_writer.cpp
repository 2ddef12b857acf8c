#include <iterator>

#include "core/io/files/byte_stream.h"
#include "core/io/files/png.h"
#include "core/io/models/obj.h"

namespace flytri::io {
namespace {

/// With the digits that bring every float back.
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

}  // namespace

Result<void> write_obj(const std::filesystem::path& path, const TexturedMesh& model) {
  const bool is_textured = !model.atlas.empty();
  const std::filesystem::path image = std::filesystem::path(path).replace_extension(".png");
  const std::filesystem::path materials = std::filesystem::path(path).replace_extension(".mtl");
  Result<ByteWriter> out = ByteWriter::create(path);
  if (!out) return tl::unexpected(out.error());
  out->text("# flytri, millimeters\n");
  if (is_textured) {
    out->text(fmt::format("mtllib {}\nusemtl surface\n", materials.filename().string()));
  }
  put_vertices(*out, model);
  put_faces(*out, model);
  if (is_textured) {
    if (Result<void> written = write_png(image, model.atlas); !written) return written;
    const std::string text =
        fmt::format("# flytri\nnewmtl surface\nKa 0 0 0\nKd 1 1 1\nKs 0 0 0\nillum 1\nmap_Kd {}\n",
                    image.filename().string());
    if (Result<void> written = write_file(materials, text); !written) return written;
  }
  return out->commit();
}

}  // namespace flytri::io
