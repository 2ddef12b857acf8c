#include "core/io/models/model.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <utility>

#include "core/io/files/file_bytes.h"
#include "core/io/models/glb.h"
#include "core/io/models/obj.h"
#include "core/io/models/ply.h"
#include "core/io/models/stl.h"

namespace flytri::io {
namespace {

enum class Format { kGlb, kPly, kStl, kObj };

constexpr std::array<std::pair<const char*, Format>, 4> kEndings = {{{".glb", Format::kGlb},
                                                                     {".ply", Format::kPly},
                                                                     {".stl", Format::kStl},
                                                                     {".obj", Format::kObj}}};

Result<Format> format_of(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  for (const auto& [known, format] : kEndings) {
    if (ending == known) return format;
  }
  return fail(ErrorCode::kBadOption,
              "{}: unknown kind of model; the name must end in .glb, .ply, .stl or .obj",
              path.string());
}

bool triangles_fit(const TriangleMesh& mesh) {
  return std::all_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const Triangle& triangle) {
    return *std::max_element(triangle.begin(), triangle.end()) < mesh.vertices.size();
  });
}

bool numbers_are_finite(const TriangleMesh& mesh) {
  return std::all_of(mesh.vertices.begin(), mesh.vertices.end(), [](const SurfacePoint& point) {
    return point.position_mm.allFinite() && point.normal.allFinite();
  });
}

Result<void> check_model(const TexturedMesh& model, const std::filesystem::path& path) {
  if (model.mesh.triangles.empty()) {
    return fail(ErrorCode::kInsufficient, "{}: not written: there is no surface", path.string());
  }
  if (!triangles_fit(model.mesh) || !numbers_are_finite(model.mesh)) {
    return fail(ErrorCode::kInconsistent, "{}: not written: the mesh is damaged", path.string());
  }
  if (!model.atlas.empty() && model.uv.size() != model.mesh.vertices.size()) {
    return fail(ErrorCode::kInconsistent, "{}: not written: the texture does not fit the mesh",
                path.string());
  }
  return {};
}

Result<TexturedMesh> parse(Format format, const std::string& bytes, const std::string& name) {
  if (format == Format::kGlb) return parse_glb(bytes, name);
  if (format == Format::kStl) {
    return parse_stl(bytes, name).map([](TriangleMesh&& mesh) {
      return TexturedMesh{std::move(mesh), {}, {}};
    });
  }
  return parse_ply(bytes, name).map([](PlyMesh&& ply) {
    return TexturedMesh{std::move(ply.mesh), {}, {}};
  });
}

}  // namespace

bool carries_atlas(const std::filesystem::path& path) {
  const Result<Format> format = format_of(path);
  return format && (*format == Format::kGlb || *format == Format::kObj);
}

Result<void> check_model_path(const std::filesystem::path& path) {
  return format_of(path).map([](Format) {});
}

Result<void> write_model(const std::filesystem::path& path, const TexturedMesh& model) {
  const Result<Format> format = format_of(path);
  if (!format) return tl::unexpected(format.error());
  if (Result<void> fine = check_model(model, path); !fine) return fine;
  switch (*format) {
    case Format::kGlb:
      return write_glb(path, model);
    case Format::kPly:
      return write_ply(path, model.mesh);
    case Format::kStl:
      return write_stl(path, model.mesh);
    case Format::kObj:
      return write_obj(path, model);
  }
  return {};
}

Result<TexturedMesh> read_model(const std::filesystem::path& path) {
  const Result<Format> format = format_of(path);
  if (!format) return tl::unexpected(format.error());
  if (*format == Format::kObj) return read_obj(path);
  return read_file(path).and_then(
      [&](const std::string& bytes) { return parse(*format, bytes, path.string()); });
}

}  // namespace flytri::io
