#include "app/session/export_files.h"

#include "core/io/files/file_bytes.h"
#include "core/io/models/model.h"
#include "core/io/models/model_formats.h"

namespace flytri::session {
namespace {

namespace fs = std::filesystem;

/// The surfels that the window shows, as points.
PointCloud points_of(const SurfelModel& model) {
  PointCloud points;
  points.reserve(surfel_count(model));
  for (const auto& block : model) {
    for (const Surfel& surfel : block->surfels) {
      points.push_back({surfel.position_mm, surfel.normal, surfel.color, surfel.sigma_mm});
    }
  }
  return points;
}

/// About the size of a finished scan's files.
std::uint64_t size_of_mesh(const TexturedMesh& model, const io::ModelFormat& format) {
  // A PNG of a jaw takes about half the bytes of its pixels.
  const std::uint64_t atlas = model.atlas.total() * model.atlas.elemSize() / 2;
  return format.vertex_bytes * model.mesh.vertices.size() +
         format.triangle_bytes * model.mesh.triangles.size() + (format.holds_texture ? atlas : 0);
}

Result<void> write_mesh(const fs::path& file, const reconstruct::FinishedScan& result) {
  if (io::holds_texture(file)) return io::write_model(file, result.model);
  TexturedMesh uncut;
  uncut.mesh = result.surface.mesh;
  return io::write_model(file, uncut);
}

Result<void> write_points(const fs::path& file, const PointCloud& points) {
  const Result<const io::ModelFormat*> format = io::model_format_of(file);
  if (!format) return tl::unexpected(format.error());
  if ((*format)->write_points != nullptr) return (*format)->write_points(file, points);
  return fail(ErrorCode::kInsufficient,
              "{}: cannot be written before the scan is finished, as it needs the surface: press "
              "Finish, or export points as {}",
              file.string(), io::extension_list(io::FormatUse::kWritePoints));
}

}  // namespace

std::map<std::string_view, std::uint64_t> estimated_bytes(const scan::ScanSnapshot& shown) {
  std::map<std::string_view, std::uint64_t> bytes;
  for (const io::ModelFormat& format : io::model_formats()) {
    if (shown.result != nullptr) {
      bytes[format.extension] = size_of_mesh(shown.result->model, format);
    } else if (format.write_points != nullptr && !shown.model.empty()) {
      bytes[format.extension] = format.vertex_bytes * surfel_count(shown.model);
    }
  }
  return bytes;
}

Result<std::vector<ui::ExportedFile>> export_files(const scan::ScanSnapshot& shown,
                                                   const fs::path& stem,
                                                   const std::vector<std::string_view>& formats) {
  if (shown.result == nullptr && shown.model.empty()) {
    return fail(ErrorCode::kInsufficient, "there is no surface to export yet; scan first");
  }
  if (auto made = io::create_folder(stem.parent_path()); !made) return tl::unexpected(made.error());
  std::vector<ui::ExportedFile> written;
  for (const std::string_view extension : formats) {
    const fs::path file = stem.string() + std::string(extension);
    const Result<void> done =
        shown.result ? write_mesh(file, *shown.result) : write_points(file, points_of(shown.model));
    if (!done) return tl::unexpected(done.error());
    std::error_code error;
    written.push_back({file.string(), fs::file_size(file, error)});
  }
  return written;
}

}  // namespace flytri::session
