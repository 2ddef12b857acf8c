#include "app/cli/export_jaws.h"

#include <fmt/format.h>

#include <array>
#include <optional>
#include <string>
#include <utility>

#include "app/cli/case_part.h"
#include "app/cli/console.h"
#include "app/cli/output_files.h"
#include "app/cli/report.h"
#include "core/evaluation/surface_error.h"
#include "core/io/files/file_bytes.h"
#include "core/io/models/glb.h"
#include "core/occlusion/occlude.h"
#include "core/occlusion/patient_frame.h"

namespace flytri::cli {
namespace {

namespace fs = std::filesystem;

/// A finished stage, and where it lies.
struct Jaw {
  io::ScanStage stage;
  Part part;
  Isometry T_patient_world = Isometry::Identity();
};

Result<std::vector<Jaw>> load_jaws(io::CaseFile& file) {
  std::vector<Jaw> jaws;
  for (const io::ScanStage stage : io::kScanStages) {
    const Result<io::StageCounts> counts = file.counts(stage);
    if (!counts) return tl::unexpected(counts.error());
    if (!counts->has_result) continue;
    Result<Part> part = load_part(file, stage);
    if (!part) return tl::unexpected(part.error());
    jaws.push_back({stage, *std::move(part)});
  }
  if (!jaws.empty()) return jaws;
  return fail(ErrorCode::kInsufficient,
              "{}: no stage has a finished model; make one with flytri reconstruct --keep",
              file.path().string());
}

Jaw* jaw_of(std::vector<Jaw>& jaws, io::ScanStage stage) {
  for (Jaw& jaw : jaws) {
    if (jaw.stage == stage) return &jaw;
  }
  return nullptr;
}

/// Lays the jaws as they bite, in the frame of the patient.
Result<void> place_jaws(std::vector<Jaw>& jaws, const Progress& progress) {
  Jaw* const upper = jaw_of(jaws, io::ScanStage::kUpper);
  Jaw* const lower = jaw_of(jaws, io::ScanStage::kLower);
  Jaw* const bite = jaw_of(jaws, io::ScanStage::kBite);
  if (upper != nullptr)
    upper->T_patient_world = occlusion::T_patient_jaw(upper->part.surface, JawKind::kUpper);
  if (lower != nullptr)
    lower->T_patient_world = occlusion::T_patient_jaw(lower->part.surface, JawKind::kLower);
  if (upper == nullptr || lower == nullptr || bite == nullptr) {
    if (jaws.size() > 1) {
      print_error(
          "flytri: warning: the jaws do not lie as they bite, each is in its own occlusal plane: "
          "finish the scans of the upper jaw, the lower jaw and the bite\n");
    }
    return {};
  }
  const std::array bites = {occlusion::BiteScan{bite->part.name, bite->part.surface.vertices}};
  const auto occlusion = occlusion::find_occlusion(upper->part.surface, lower->part.surface, bites,
                                                   {}, Workers(), progress);
  if (!occlusion) return tl::unexpected(occlusion.error());
  lower->T_patient_world = upper->T_patient_world * occlusion->T_upper_lower;
  bite->T_patient_world = upper->T_patient_world * occlusion->bites.front().T_upper_bite;
  return {};
}

bool holds_all_jaws(const fs::path& output) { return output.extension() == ".glb"; }

/// NAME.stl and upper: NAME-upper.stl.
fs::path path_of(const fs::path& output, io::ScanStage stage) {
  fs::path path = output;
  path.replace_filename(fmt::format("{}-{}{}", output.stem().string(), to_string(stage),
                                    output.extension().string()));
  return path;
}

std::vector<fs::path> files_of(const JawsExport& wanted, const std::vector<Jaw>& jaws) {
  std::vector<fs::path> files;
  for (const fs::path& output : wanted.outputs) {
    if (holds_all_jaws(output)) {
      files.push_back(output);
      continue;
    }
    for (const Jaw& jaw : jaws) files.push_back(path_of(output, jaw.stage));
  }
  return files;
}

using PlacedModel = std::pair<io::ScanStage, reconstruct::ModelAtDensity>;

/// The jaws in the density and the frame in which they are written.
Result<std::vector<PlacedModel>> placed_models(const std::vector<Jaw>& jaws,
                                               reconstruct::MeshDensity density,
                                               const Progress& progress) {
  progress.begin_stage(reconstruct::kThinningTriangles, jaws.size());
  std::vector<PlacedModel> models;
  for (const Jaw& jaw : jaws) {
    Result<reconstruct::ModelAtDensity> model =
        reconstruct::at_density(jaw.part.model, density, progress);
    if (!model) return tl::unexpected(model.error());
    print_density(*model);
    model->model.mesh = evaluation::transformed(model->model.mesh, jaw.T_patient_world);
    model->uncut = evaluation::transformed(model->uncut, jaw.T_patient_world);
    models.emplace_back(jaw.stage, *std::move(model));
  }
  return models;
}

Result<void> write_scene(const fs::path& output, const std::vector<PlacedModel>& models) {
  std::vector<io::NamedModel> named;
  named.reserve(models.size());
  for (const auto& [stage, model] : models)
    named.push_back({std::string(to_string(stage)), &model.model});
  const Result<std::string> glb =
      io::encode_glb_scene(named, output.string(), io::GlbAxes::kPatient);
  if (!glb) return tl::unexpected(glb.error());
  return io::write_file(output, *glb, io::Access::kOwnerOnly);
}

/// @param written  gets the files that are complete
Result<void> write_all_jaws(const JawsExport& wanted, const std::vector<PlacedModel>& models,
                            std::vector<fs::path>& written) {
  const auto note = [&](const fs::path& file) {
    written.push_back(file);
    print_out("wrote {}\n", file.string());
  };
  for (const fs::path& output : wanted.outputs) {
    if (holds_all_jaws(output)) {
      if (auto done = write_scene(output, models); !done) return done;
      note(output);
      continue;
    }
    for (const auto& [stage, model] : models) {
      const fs::path path = path_of(output, stage);
      if (auto done = write_result(path, model); !done) return done;
      note(path);
    }
  }
  return {};
}

}  // namespace

Result<void> export_jaws(const JawsExport& wanted, CaseAccess& access, const Progress& progress) {
  Result<io::CaseFile> file = access.open(true);
  if (!file) return tl::unexpected(file.error());
  Result<std::vector<Jaw>> jaws = load_jaws(*file);
  if (!jaws) return tl::unexpected(jaws.error());
  if (auto checked = check_output_files(files_of(wanted, *jaws), {}, wanted.force); !checked)
    return checked;
  if (auto placed = place_jaws(*jaws, progress); !placed) return placed;
  const Result<std::vector<PlacedModel>> models = placed_models(*jaws, wanted.density, progress);
  if (!models) return tl::unexpected(models.error());
  std::vector<fs::path> written;
  Result<void> done = write_all_jaws(wanted, *models, written);
  if (!written.empty()) access.note(io::CaseAction::kExported, std::nullopt, written);
  return done;
}

}  // namespace flytri::cli
