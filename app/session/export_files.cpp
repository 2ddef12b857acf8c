#include "app/session/export_files.h"

#include "core/io/files/file_bytes.h"
#include "core/io/models/model.h"
#include "core/io/models/ply.h"

namespace flytri::session {
namespace {

namespace fs = std::filesystem;

/// The surfels of the model as points.
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

Result<void> write_mesh(const fs::path& file, const reconstruct::FinishedScan& result) {
  if (io::carries_atlas(file)) return io::write_model(file, result.model);
  TexturedMesh uncut;
  uncut.mesh = result.surface.mesh;
  return io::write_model(file, uncut);
}

}  // namespace

std::optional<std::uint64_t> estimated_bytes(const scan::ScanSnapshot& shown,
                                             ui::ExportFormat format) {
  // Bytes for each vertex and triangle that the writers put into the files.
  constexpr std::uint64_t kPlyVertex = 31, kPlyTriangle = 13, kStlTriangle = 50;
  constexpr std::uint64_t kGlbVertex = 36, kGlbTriangle = 12, kObjVertex = 95, kObjTriangle = 45;
  if (shown.result == nullptr) {
    if (format != ui::ExportFormat::kPly || shown.model.empty()) return std::nullopt;
    return kPlyVertex * surfel_count(shown.model);
  }
  const TexturedMesh& model = shown.result->model;
  const std::uint64_t vertices = model.mesh.vertices.size();
  const std::uint64_t triangles = model.mesh.triangles.size();
  // A PNG of a jaw takes about half of its pixels' bytes.
  const std::uint64_t atlas = model.atlas.total() * model.atlas.elemSize() / 2;
  switch (format) {
    case ui::ExportFormat::kGlb:
      return kGlbVertex * vertices + kGlbTriangle * triangles + atlas;
    case ui::ExportFormat::kPly:
      return kPlyVertex * vertices + kPlyTriangle * triangles;
    case ui::ExportFormat::kStl:
      return kStlTriangle * triangles;
    case ui::ExportFormat::kObj:
      return kObjVertex * vertices + kObjTriangle * triangles + atlas;
  }
  return std::nullopt;
}

Result<std::vector<ui::ExportedFile>> export_files(const scan::ScanSnapshot& shown,
                                                   const fs::path& stem,
                                                   const std::vector<ui::ExportFormat>& formats) {
  if (shown.result == nullptr && shown.model.empty()) {
    return fail(ErrorCode::kInsufficient, "there is no surface to export yet; scan first");
  }
  if (auto made = io::create_folder(stem.parent_path()); !made) return tl::unexpected(made.error());
  std::vector<ui::ExportedFile> written;
  for (const ui::ExportFormat format : formats) {
    const fs::path file = stem.string() + std::string(ui::to_string(format));
    if (shown.result == nullptr && format != ui::ExportFormat::kPly) {
      return fail(ErrorCode::kInsufficient,
                  "{}: an unfinished scan has only points; finish it first, or export as .ply",
                  file.string());
    }
    const Result<void> done = shown.result
                                  ? write_mesh(file, *shown.result)
                                  : io::write_point_cloud_ply(file, points_of(shown.model));
    if (!done) return tl::unexpected(done.error());
    std::error_code error;
    written.push_back({file.string(), fs::file_size(file, error)});
  }
  return written;
}

}  // namespace flytri::session
