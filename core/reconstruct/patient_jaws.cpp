#include "core/reconstruct/patient_jaws.h"

#include <fmt/format.h>

#include <utility>

#include "core/evaluation/surface_error.h"
#include "core/io/files/file_bytes.h"
#include "core/io/models/glb.h"
#include "core/io/models/model.h"
#include "core/occlusion/occlude.h"
#include "core/occlusion/patient_frame.h"

namespace flytri::reconstruct {
namespace {

namespace fs = std::filesystem;

const FinishedJaw* jaw_of(std::span<const FinishedJaw> jaws, io::ScanStage stage) {
  for (const FinishedJaw& jaw : jaws) {
    if (jaw.stage == stage) return &jaw;
  }
  return nullptr;
}

bool holds_all_jaws(const fs::path& output) { return output.extension() == ".glb"; }

fs::path model_of(const fs::path& output, io::ScanStage stage) {
  fs::path path = output;
  path.replace_filename(fmt::format("{}-{}{}", output.stem().string(), to_string(stage),
                                    output.extension().string()));
  return path;
}

Result<void> write_scene(const fs::path& output, std::span<const PatientJaw> jaws) {
  std::vector<io::NamedModel> named;
  named.reserve(jaws.size());
  for (const PatientJaw& jaw : jaws)
    named.push_back({std::string(to_string(jaw.stage)), &jaw.model.model});
  const Result<std::string> glb =
      io::encode_glb_scene(named, output.string(), io::GlbAxes::kPatient);
  if (!glb) return tl::unexpected(glb.error());
  return io::write_file(output, *glb, io::Access::kOwnerOnly);
}

}  // namespace

Result<JawPlaces> place_jaws(std::span<const FinishedJaw> jaws, const Workers& workers,
                             const Progress& progress) {
  JawPlaces places;
  places.T_patient_world.fill(Isometry::Identity());
  Isometry& T_upper = places.of(io::ScanStage::kUpper);
  Isometry& T_lower = places.of(io::ScanStage::kLower);
  const FinishedJaw* const upper = jaw_of(jaws, io::ScanStage::kUpper);
  const FinishedJaw* const lower = jaw_of(jaws, io::ScanStage::kLower);
  if (upper != nullptr) T_upper = occlusion::T_patient_jaw(*upper->surface, JawKind::kUpper);
  if (lower != nullptr) T_lower = occlusion::T_patient_jaw(*lower->surface, JawKind::kLower);
  std::vector<io::ScanStage> stages;
  std::vector<occlusion::BiteScan> bites;
  for (const FinishedJaw& jaw : jaws) {
    if (!io::is_bite(jaw.stage)) continue;
    stages.push_back(jaw.stage);
    bites.push_back({jaw.name, jaw.surface->vertices});
  }
  if (upper == nullptr || lower == nullptr || bites.empty()) return places;
  const auto occlusion =
      occlusion::find_occlusion(*upper->surface, *lower->surface, bites, {}, workers, progress);
  if (!occlusion) return tl::unexpected(occlusion.error());
  T_lower = T_upper * occlusion->T_upper_lower;
  for (std::size_t i = 0; i < stages.size(); ++i)
    places.of(stages[i]) = T_upper * occlusion->bites[i].T_upper_bite;
  places.are_closed = true;
  return places;
}

PatientJaw in_patient(io::ScanStage stage, ModelAtDensity model, const JawPlaces& places) {
  const Isometry& T = places.T_patient_world[index_of(stage)];
  model.model.mesh = evaluation::transformed(model.model.mesh, T);
  model.uncut = evaluation::transformed(model.uncut, T);
  return {stage, std::move(model)};
}

std::vector<fs::path> jaw_models(const fs::path& output, std::span<const io::ScanStage> stages) {
  if (holds_all_jaws(output)) return {output};
  std::vector<fs::path> models;
  models.reserve(stages.size());
  for (const io::ScanStage stage : stages) models.push_back(model_of(output, stage));
  return models;
}

Result<void> write_jaws(const fs::path& output, std::span<const PatientJaw> jaws,
                        std::vector<fs::path>& written) {
  if (holds_all_jaws(output)) {
    if (auto done = write_scene(output, jaws); !done) return done;
    written.push_back(output);
    return {};
  }
  for (const PatientJaw& jaw : jaws) {
    const fs::path path = model_of(output, jaw.stage);
    if (auto done = io::write_model(path, jaw.model.model, jaw.model.uncut); !done) return done;
    written.push_back(path);
  }
  return {};
}

}  // namespace flytri::reconstruct
