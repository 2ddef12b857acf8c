#include "core/reconstruct/patient_jaws.h"

#include <fmt/format.h>

#include <utility>

#include "core/evaluation/surface_error.h"
#include "core/io/files/file_bytes.h"
#include "core/io/models/glb.h"
#include "core/io/models/model.h"
#include "core/occlusion/occlude.h"
#include "core/occlusion/patient_frame.h"
#include "core/reconstruct/same_jaw.h"

namespace flytri::reconstruct {
namespace {

namespace fs = std::filesystem;

const FinishedJaw* jaw_of(std::span<const FinishedJaw> jaws, io::ScanStage stage) {
  for (const FinishedJaw& jaw : jaws) {
    if (jaw.stage == stage) return &jaw;
  }
  return nullptr;
}

/// In its own occlusal plane.
Result<Isometry> T_patient_world(const FinishedJaw& jaw, JawKind kind) {
  if (!jaw.plane) return occlusion::T_patient_jaw(*jaw.surface, kind);
  auto T = occlusion::T_patient_jaw(*jaw.surface, kind, *jaw.plane);
  if (T) return T;
  return fail(T.error().code,
              "{}: the occlusal plane that was set does not fit the scan: {}; or let the program "
              "find the plane",
              jaw.name, T.error().message);
}

/// Of the scans of one jaw, the one on which the others are placed: the ordinary one if there is
/// one.
const FinishedJaw* main_of(std::span<const FinishedJaw> jaws, io::ScanStage base) {
  const FinishedJaw* main = nullptr;
  for (const FinishedJaw& jaw : jaws) {
    if (base_of(jaw.stage) == base && (main == nullptr || jaw.stage < main->stage)) main = &jaw;
  }
  return main;
}

/// Places the lower jaw and the bites on the upper jaw, if none of them is missing.
Result<void> close_jaws(std::span<const FinishedJaw> jaws, const Workers& workers,
                        const Progress& progress, JawPlaces& places) {
  std::vector<io::ScanStage> stages;
  std::vector<occlusion::BiteScan> bites;
  for (const FinishedJaw& jaw : jaws) {
    if (!io::is_bite(jaw.stage)) continue;
    stages.push_back(jaw.stage);
    bites.push_back({jaw.name, jaw.surface->vertices});
  }
  const FinishedJaw* const upper = jaw_of(jaws, io::ScanStage::kUpper);
  const FinishedJaw* const lower = jaw_of(jaws, io::ScanStage::kLower);
  if (upper == nullptr || lower == nullptr || bites.empty()) return {};
  const auto occlusion =
      occlusion::find_occlusion(*upper->surface, *lower->surface, bites, {}, workers, progress);
  if (!occlusion) return tl::unexpected(occlusion.error());
  Isometry& T_upper = places.of(io::ScanStage::kUpper);
  Isometry& T_lower = places.of(io::ScanStage::kLower);
  const bool lower_counts = lower->plane && !upper->plane;
  if (lower_counts) T_upper = T_lower * occlusion->T_upper_lower.inverse();
  T_lower = T_upper * occlusion->T_upper_lower;
  for (std::size_t i = 0; i < stages.size(); ++i)
    places.of(stages[i]) = T_upper * occlusion->bites[i].T_upper_bite;
  places.are_closed = true;
  return {};
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
  for (const auto& [base, kind] : {std::pair{io::ScanStage::kUpper, JawKind::kUpper},
                                   std::pair{io::ScanStage::kLower, JawKind::kLower}}) {
    const FinishedJaw* const jaw = main_of(jaws, base);
    if (jaw == nullptr) continue;
    const auto found = T_patient_world(*jaw, kind);
    if (!found) return tl::unexpected(found.error());
    places.of(jaw->stage) = *found;
  }
  if (auto closed = close_jaws(jaws, workers, progress, places); !closed)
    return tl::unexpected(closed.error());
  for (const FinishedJaw& jaw : jaws) {
    const FinishedJaw& main = *main_of(jaws, base_of(jaw.stage));
    if (io::is_bite(jaw.stage) || main.stage == jaw.stage) continue;
    const auto T_main_jaw =
        place_on_jaw({main.name, main.surface}, {jaw.name, jaw.surface}, workers);
    if (!T_main_jaw) return tl::unexpected(T_main_jaw.error());
    places.of(jaw.stage) = places.of(main.stage) * *T_main_jaw;
  }
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
