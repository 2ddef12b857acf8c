#include "app/session/export_jaws.h"

#include <utility>

#include "core/reconstruct/patient_jaws.h"
#include "ui/state/jaw_words.h"

namespace flytri::session {
namespace {

namespace fs = std::filesystem;

/// Where files are written, and which of them are models.
struct JawFiles {
  std::vector<fs::path> outputs;  ///< as for reconstruct::write_jaws()
  std::vector<fs::path> files;
};

JawFiles jaw_files(const fs::path& stem, const std::vector<JawToExport>& jaws,
                   const std::vector<std::string_view>& formats) {
  std::vector<io::ScanStage> stages;
  stages.reserve(jaws.size());
  for (const JawToExport& jaw : jaws) stages.push_back(jaw.stage);
  JawFiles files;
  for (const std::string_view extension : formats) {
    files.outputs.emplace_back(stem.string() + std::string(extension));
    const auto models = reconstruct::jaw_models(files.outputs.back(), stages);
    // One for each jaw, or a .glb, which holds its textures.
    for (std::size_t i = 0; i < models.size(); ++i) {
      const auto written = session::files_of(models[i], !jaws[i].scan->model.atlas.empty());
      files.files.insert(files.files.end(), written.begin(), written.end());
    }
  }
  return files;
}

Result<reconstruct::JawPlaces> places_of(const std::vector<JawToExport>& jaws,
                                         const ui::Texts& texts, const Progress& progress) {
  std::vector<reconstruct::FinishedJaw> finished;
  finished.reserve(jaws.size());
  for (const JawToExport& jaw : jaws) {
    finished.push_back({jaw.stage, texts[ui::stage_name(jaw.stage)], &jaw.scan->surface.mesh});
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

}  // namespace

Result<ExportOutcome> export_jaws(std::vector<JawToExport>& jaws, CaseStore& store,
                                  const ui::Export& command, std::vector<fs::path>& models_written,
                                  const ui::Texts& texts, const Progress& progress) {
  const Result<fs::path> stem = export_stem(command.target, texts);
  if (!stem) return tl::unexpected(stem.error());
  for (JawToExport& jaw : jaws) {
    if (jaw.scan != nullptr) continue;
    auto loaded = store.load_model(jaw.stage, texts);
    if (!loaded) return tl::unexpected(loaded.error());
    jaw.scan = *std::move(loaded);
  }
  const JawFiles files = jaw_files(*stem, jaws, command.target.formats);
  return write_asked(files.files, command.replaced, [&]() -> Result<void> {
    const auto places = places_of(jaws, texts, progress);
    if (!places) return tl::unexpected(places.error());
    std::vector<reconstruct::PatientJaw> placed;
    for (const JawToExport& jaw : jaws) {
      auto model = model_of(jaw, command.target.density, progress);
      if (!model) return tl::unexpected(model.error());
      placed.push_back(reconstruct::in_patient(jaw.stage, *std::move(model), *places));
    }
    for (const fs::path& output : files.outputs) {
      auto written = reconstruct::write_jaws(output, placed, models_written);
      if (!written) return written;
    }
    return {};
  });
}

}  // namespace flytri::session
