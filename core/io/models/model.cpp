#include "core/io/models/model.h"

#include <algorithm>

#include "core/io/models/model_formats.h"

namespace flytri::io {
namespace {

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
    return fail(ErrorCode::kInsufficient, "{}: not written: the model has no surface",
                path.string());
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

}  // namespace

Result<void> check_model_path(const std::filesystem::path& path) {
  return model_format_of(path).map([](const ModelFormat*) {});
}

bool holds_texture(const std::filesystem::path& path) {
  const Result<const ModelFormat*> format = model_format_of(path);
  return format && (*format)->holds_texture;
}

std::vector<std::filesystem::path> files_of_model(const std::filesystem::path& path) {
  std::vector<std::filesystem::path> files = {path};
  if (const Result<const ModelFormat*> format = model_format_of(path)) {
    for (const std::string_view companion : (*format)->companions) {
      files.push_back(std::filesystem::path(path).replace_extension(companion));
    }
  }
  return files;
}

Result<void> write_model(const std::filesystem::path& path, const TexturedMesh& model) {
  const Result<const ModelFormat*> format = model_format_of(path);
  if (!format) return tl::unexpected(format.error());
  if (Result<void> fine = check_model(model, path); !fine) return fine;
  return (*format)->write(path, model);
}

Result<void> write_model(const std::filesystem::path& path, const TexturedMesh& cut,
                         const TriangleMesh& uncut) {
  return holds_texture(path) ? write_model(path, cut)
                             : write_model(path, TexturedMesh{uncut, {}, {}});
}

Result<TexturedMesh> read_model(const std::filesystem::path& path) {
  const Result<const ModelFormat*> format = model_format_of(path);
  if (!format) return tl::unexpected(format.error());
  if ((*format)->read != nullptr) return (*format)->read(path);
  return fail(ErrorCode::kBadOption, "{}: {} files can be written but not read; read {}",
              path.string(), (*format)->extension, extension_list(FormatUse::kRead));
}

}  // namespace flytri::io
