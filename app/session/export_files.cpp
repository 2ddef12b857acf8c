#include "app/session/export_files.h"

#include <algorithm>

#include "app/report/write_report.h"
#include "app/session/user_folders.h"
#include "core/io/files/file_bytes.h"
#include "core/io/files/former_file.h"
#include "core/io/files/leftovers.h"
#include "core/io/models/model.h"
#include "core/io/models/model_formats.h"
#include "core/reconstruct/margin_files.h"
#include "ui/state/export_target.h"

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

/// What is written of a finished scan.
struct FinishedModel {
  const TexturedMesh& cut;
  const TriangleMesh& uncut;
};

Result<void> write_points(const fs::path& file, const PointCloud& points, const ui::Texts& texts) {
  const Result<const io::ModelFormat*> format = io::model_format_of(file);
  if (!format) return tl::unexpected(format.error());
  if ((*format)->write_points != nullptr) return (*format)->write_points(file, points);
  return fail(ErrorCode::kInsufficient, "{}",
              texts.fill<ui::Text::kFinishFirst>(file.string(),
                                                 io::extension_list(io::FormatUse::kWritePoints)));
}

/// Writes each model as the surface, or as points before the scan is finished.
Result<void> write_models(const std::vector<fs::path>& models, const scan::ScanSnapshot& shown,
                          const FinishedModel* finished, const ui::Texts& texts,
                          std::vector<fs::path>& written) {
  for (const fs::path& model : models) {
    auto done = finished != nullptr ? io::write_model(model, finished->cut, finished->uncut)
                                    : write_points(model, points_of(shown.model), texts);
    if (!done) return done;
    written.push_back(model);
  }
  return {};
}

/// As write_models, for a finished scan in the density that is asked for.
Result<void> write_finished(const std::vector<fs::path>& models, const scan::ScanSnapshot& shown,
                            reconstruct::MeshDensity density, LighterModels& lighter,
                            const Progress& progress, std::vector<fs::path>& written) {
  if (models.empty()) return {};
  if (density == reconstruct::MeshDensity::kFull) {
    const FinishedModel full = {shown.result->model, shown.result->surface.mesh};
    return write_models(models, shown, &full, {}, written);
  }
  const Result<LighterModels::Model> made = lighter.get(density, progress);
  if (!made) return tl::unexpected(made.error());
  const FinishedModel model = {(*made)->model, (*made)->uncut};
  return write_models(models, shown, &model, {}, written);
}

/// The files of an export that exist and that the user did not allow to replace.
Result<std::vector<std::string>> not_replaceable(const std::vector<fs::path>& files,
                                                 const std::vector<std::string>& replaced) {
  std::vector<std::string> existing;
  for (const fs::path& file : files) {
    const std::string kind = io::kind_by_name(file);
    const io::Former former = io::former_at(file, kind);
    if (former == io::Former::kOtherKind) return io::other_kind(file, kind);
    const bool may_replace =
        std::find(replaced.begin(), replaced.end(), file.string()) != replaced.end();
    if (former == io::Former::kSameKind && !may_replace) existing.push_back(file.string());
  }
  return existing;
}

std::vector<review::Polyline> margins_of(const ShownScan& shown) {
  if (shown.scan.result == nullptr) return {};
  return reconstruct::margins_on(shown.scan.result->surface.mesh, shown.margins, Workers()).lines;
}

Result<void> check_name(const std::string& name, const ui::Texts& texts) {
  const bool is_plain = std::none_of(name.begin(), name.end(), [](char c) {
    return c == '/' || c == '\\' || static_cast<unsigned char>(c) < 0x20U;
  });
  if (is_plain && !name.empty() && name.front() != '.') return {};
  return fail(ErrorCode::kBadOption, "{}", texts.fill<ui::Text::kNotAFileName>(name));
}

}  // namespace

std::map<std::string_view, std::uint64_t> estimated_bytes(const scan::ScanSnapshot& shown,
                                                          const TexturedMesh* model) {
  std::map<std::string_view, std::uint64_t> bytes;
  for (const io::ModelFormat& format : io::model_formats()) {
    if (shown.result != nullptr) {
      bytes[format.extension] = model == nullptr ? 0 : size_of_mesh(*model, format);
    } else if (format.write_points != nullptr && !shown.model.empty()) {
      bytes[format.extension] = format.vertex_bytes * surfel_count(shown.model);
    }
  }
  return bytes;
}

Result<fs::path> export_stem(const ui::ExportTarget& target, const ui::Texts& texts) {
  if (auto checked = check_name(target.name, texts); !checked) {
    return tl::unexpected(checked.error());
  }
  return typed_folder(target.folder, texts).map([&](const fs::path& folder) {
    return folder / target.name;
  });
}

std::vector<fs::path> files_of(const fs::path& model, bool has_texture) {
  return has_texture ? io::files_of_model(model) : std::vector<fs::path>{model};
}

Result<ExportOutcome> write_asked(const std::vector<fs::path>& files,
                                  const std::vector<std::string>& replaced,
                                  const std::function<Result<void>()>& write) {
  const auto existing = not_replaceable(files, replaced);
  if (!existing) return tl::unexpected(existing.error());
  if (!existing->empty()) return ExportOutcome{{}, *existing};
  const fs::path folder = files.front().parent_path();
  if (auto made = io::create_private_folder(folder); !made) return tl::unexpected(made.error());
  io::remove_leftovers(folder);
  if (const Result<void> done = write(); !done) return tl::unexpected(done.error());
  ExportOutcome outcome;
  for (const fs::path& file : files) {
    std::error_code error;
    outcome.written.push_back({file.string(), fs::file_size(file, error)});
  }
  return outcome;
}

Result<ReportFile> report_file(const fs::path& path, const FindFacts& find,
                               const ui::Texts& texts) {
  const auto why_not = [&](const std::string& reason) {
    return fail(ErrorCode::kInsufficient, "{}", texts.fill<ui::Text::kNoReport>(reason));
  };
  if (!find) return why_not(texts[ui::Text::kReportNeedsCase]);
  auto facts = find();
  if (!facts) return why_not(facts.error().message);
  return ReportFile{path, *std::move(facts)};
}

Result<void> write_reports(const std::vector<ReportFile>& reports, std::vector<fs::path>& written) {
  for (const ReportFile& report : reports) {
    if (auto done = report::write_report(report.path, report.facts); !done) return done;
    written.push_back(report.path);
  }
  return {};
}

Result<ExportOutcome> export_files(const ShownScan& shown, const ui::Export& command,
                                   std::vector<fs::path>& written, const ui::Texts& texts,
                                   const Progress& progress) {
  const scan::ScanSnapshot& scan = shown.scan;
  const ui::ExportTarget& target = command.target;
  if (scan.result == nullptr && (scan.model.empty() || target.report)) {
    return fail(ErrorCode::kInsufficient, "{}", texts[ui::Text::kNoSurfaceToExport]);
  }
  const Result<fs::path> stem = export_stem(target, texts);
  if (!stem) return tl::unexpected(stem.error());
  const bool has_texture = scan.result && !scan.result->model.atlas.empty();
  std::vector<fs::path> models, files;
  for (const std::string_view extension : target.formats) {
    models.emplace_back(stem->string() + std::string(extension));
    const std::vector<fs::path> more = files_of(models.back(), has_texture);
    files.insert(files.end(), more.begin(), more.end());
  }
  // They lie beside a model. A report alone has none.
  std::vector<review::Polyline> margins;
  fs::path margin_file;
  if (!models.empty()) {
    margins = margins_of(shown);
    margin_file = reconstruct::margin_file_of(models.front());
  }
  if (!margins.empty()) files.push_back(margin_file);
  const fs::path report = stem->string() + std::string(ui::kReportExtension);
  if (target.report) files.push_back(report);
  return write_asked(files, command.replaced, [&]() -> Result<void> {
    std::vector<ReportFile> reports;
    if (target.report) {
      auto made = report_file(report, shown.facts, texts);
      if (!made) return tl::unexpected(made.error());
      reports.push_back(*std::move(made));
    }
    if (scan.result == nullptr) return write_models(models, scan, nullptr, texts, written);
    LighterModels own(scan.result);
    return write_finished(models, scan, target.density, shown.lighter ? *shown.lighter : own,
                          progress, written)
        .and_then([&]() -> Result<void> {
          if (margins.empty()) return {};
          auto done = io::write_file(margin_file, reconstruct::margins_obj(margins),
                                     io::Access::kOwnerOnly);
          if (done) written.push_back(margin_file);
          return done;
        })
        .and_then([&] { return write_reports(reports, written); });
  });
}

}  // namespace flytri::session
