#include "core/io/models/model_formats.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>
#include <vector>

#include "core/io/models/glb.h"
#include "core/io/models/obj.h"
#include "core/io/models/ply.h"
#include "core/io/models/stl.h"

namespace flytri::io {
namespace {

namespace fs = std::filesystem;

TexturedMesh without_texture(TriangleMesh&& mesh) { return {std::move(mesh), {}, {}}; }

constexpr std::array<std::string_view, 2> kObjCompanions = {".mtl", ".png"};

constexpr std::array kFormats = {
    ModelFormat{.extension = ".glb",
                .purpose = "one file, with texture",
                .holds_texture = true,
                .holds_uncertainty = true,
                .vertex_bytes = 36,
                .triangle_bytes = 12,
                .read = read_glb,
                .write = write_glb},
    ModelFormat{.extension = ".ply",
                .purpose = "surface with colors",
                .holds_uncertainty = true,
                .vertex_bytes = 31,
                .triangle_bytes = 13,
                .read =
                    [](const fs::path& path) {
                      return read_ply(path).map(
                          [](PlyMesh&& ply) { return without_texture(std::move(ply.mesh)); });
                    },
                .write = [](const fs::path& path,
                            const TexturedMesh& model) { return write_ply(path, model.mesh); },
                .write_points = write_point_cloud_ply},
    ModelFormat{.extension = ".stl",
                .purpose = "shape only, for printing",
                .triangle_bytes = 50,
                .read = [](const fs::path& path) { return read_stl(path).map(without_texture); },
                .write = [](const fs::path& path,
                            const TexturedMesh& model) { return write_stl(path, model.mesh); }},
    ModelFormat{.extension = ".obj",
                .purpose = "with texture, for dental CAD",
                .holds_texture = true,
                .companions = kObjCompanions,
                .vertex_bytes = 95,
                .triangle_bytes = 45,
                .read = read_obj,
                .write = write_obj},
};

bool allows(const ModelFormat& format, FormatUse use) {
  switch (use) {
    case FormatUse::kRead:
      return format.read != nullptr;
    case FormatUse::kWrite:
      return format.write != nullptr;
    case FormatUse::kWritePoints:
      return format.write_points != nullptr;
  }
  return false;
}

}  // namespace

std::span<const ModelFormat> model_formats() { return kFormats; }

Result<const ModelFormat*> model_format_of(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  for (const ModelFormat& format : kFormats) {
    if (format.extension == extension) return &format;
  }
  return fail(ErrorCode::kBadOption, "{}: unknown model format; the name must end in {}",
              path.string(), extension_list(FormatUse::kWrite));
}

std::string extension_list(FormatUse use) {
  std::vector<std::string_view> extensions;
  for (const ModelFormat& format : kFormats) {
    if (allows(format, use)) extensions.push_back(format.extension);
  }
  std::string list;
  for (std::size_t i = 0; i < extensions.size(); ++i) {
    if (i > 0) list += i + 1 == extensions.size() ? " or " : ", ";
    list += extensions[i];
  }
  return list;
}

}  // namespace flytri::io
