#include "app/session/export_jaws.h"

#include <utility>

#include "core/reconstruct/patient_jaws.h"
#include "ui/state/export_target.h"
#include "ui/state/jaw_words.h"

namespace flytri::session {
namespace {

namespace fs = std::filesystem;

/// Where files are written, and which of them are models.
struct JawFiles {
  std::vector<fs::path> outputs;  ///< as for reconstruct::write_jaws()
  std::vector<fs::path> reports;  ///< of each jaw; empty: none are asked for
  std::vector<fs::path> files;
};

JawFiles jaw_files(const fs::path& stem, const std::vector<JawToExport>& jaws,
                   const ui::ExportTarget& target) {
  std::vector<io::ScanStage> stages;
  stages.reserve(jaws.size());
  for (const JawToExport& jaw : jaws) stages.push_back(jaw.stage);
  JawFiles files;
  for (const std::string_view extension : target.formats) {
    files.outputs.emplace_back(stem.string() + std::string(extension));
    const auto models = reconstruct::jaw_models(files.outputs.back(), stages);
    // One for each jaw, or a .glb, which holds its textures.
    for (std::size_t i = 0; i < models.size(); ++i) {
      const auto written = session::files_of(models[i], !jaws[i].scan->model.atlas.empty());
      files.files.insert(files.files.end(), written.begin(), written.end());
    }
  }
  if (!target.report) return files;
  files.reports =
      reconstruct::jaw_models(stem.string() + std::string(ui::kReportExtension), stages);
  files.files.insert(files.files.end(), files.reports.begin(), files.reports.end());
  return files;
}

/// @param paths  of each jaw; empty: no reports
Result<std::vector<ReportFile>> reports_of(const std::vector<JawToExport>& jaws,
                                           const std::vector<fs::path>& paths, CaseStore& store,
                                           const ui::Texts& texts) {
  std::vector<ReportFile> reports;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    auto report = report_file(
        paths[i], [&] { return store.facts(jaws[i].stage); }, texts);
    if (!report) return tl::unexpected(report.error());
    reports.push_back(*std::move(report));
  }
  return reports;
}

Result<reconstruct::JawPlaces> places_of(const std::vector<JawToExport>& jaws, CaseStore& store,
                                         const ui::Texts& texts, const Progress& progress) {
  std::vector<reconstruct::FinishedJaw> finished;
  finished.reserve(jaws.size());
  for (const JawToExport& jaw : jaws) {
    const auto plane = store.plane(jaw.stage);
    if (!plane) return tl::unexpected(plane.error());
    finished.push_back(
        {jaw.stage, texts[ui::stage_name(jaw.stage)], &jaw.scan->surface.mesh, *plane});
  }
  return reconstruct::place_jaws(finished, Workers(), progress);
}

Result<reconstruct::ModelAtDensity> model_of(const JawToExport& jaw,
                                             reconstruct::MeshDensity density,
                                             const Progress& progress) {
  if (density == reconstruct::MeshDensity::kFull) {
    return reconstruct::ModelAtDensity{density, jaw.scan->model, jaw.scan->surface.mesh};
  }
  LighterModels own(jaw.scan);
  return (jaw.lighter != nullptr ? *jaw.lighter : own)
      .get(density, progress)
      .map([](const LighterModels::Model& made) { return *made; });
}

Result<std::vector<reconstruct::PatientJaw>> placed_jaws(const std::vector<JawToExport>& jaws,
                                                         const reconstruct::JawPlaces& places,
                                                         reconstruct::MeshDensity density,
                                                         const Progress& progress) {
  std::vector<reconstruct::PatientJaw> placed;
  for (const JawToExport& jaw : jaws) {
    auto model = model_of(jaw, density, progress);
    if (!model) return tl::unexpected(model.error());
    placed.push_back(reconstruct::in_patient(jaw.stage, *std::move(model), places));
  }
  return placed;
}

}  // namespace

Result<ExportOutcome> export_jaws(std::vector<JawToExport>& jaws, CaseStore& store,
                                  const ui::Export& command, std::vector<fs::path>& written,
                                  const ui::Texts& texts, const Progress& progress) {
  const Result<fs::path> stem = export_stem(command.target, texts);
  if (!stem) return tl::unexpected(stem.error());
  for (JawToExport& jaw : jaws) {
    if (jaw.scan != nullptr) continue;
    auto loaded = store.load_model(jaw.stage, texts);
    if (!loaded) return tl::unexpected(loaded.error());
    jaw.scan = *std::move(loaded);
  }
  const JawFiles files = jaw_files(*stem, jaws, command.target);
  return write_asked(files.files, command.replaced, [&]() -> Result<void> {
    const auto reports = reports_of(jaws, files.reports, store, texts);
    if (!reports) return tl::unexpected(reports.error());
    if (files.outputs.empty()) return write_reports(*reports, written);
    const auto places = places_of(jaws, store, texts, progress);
    if (!places) return tl::unexpected(places.error());
    const auto placed = placed_jaws(jaws, *places, command.target.density, progress);
    if (!placed) return tl::unexpected(placed.error());
    for (const fs::path& output : files.outputs) {
      auto done = reconstruct::write_jaws(output, *placed, written);
      if (!done) return done;
    }
    return write_reports(*reports, written);
  });
}

}  // namespace flytri::session
