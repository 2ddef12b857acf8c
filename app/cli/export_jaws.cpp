#include "app/cli/export_jaws.h"

#include <optional>
#include <utility>

#include "app/cli/case_part.h"
#include "app/cli/console.h"
#include "app/cli/output_files.h"
#include "app/cli/report.h"
#include "core/reconstruct/jaw_spans.h"
#include "core/reconstruct/patient_jaws.h"

namespace flytri::cli {
namespace {

namespace fs = std::filesystem;

/// A finished stage of the case.
struct Jaw {
  io::ScanStage stage;
  Part part;
};

Result<std::vector<Jaw>> load_jaws(io::CaseFile& file) {
  std::vector<Jaw> jaws;
  for (const io::ScanStage stage : io::kScanStages) {
    if (stage == io::ScanStage::kFace) continue;
    const Result<io::StageCounts> counts = file.counts(stage);
    if (!counts) return tl::unexpected(counts.error());
    if (!counts->has_result) continue;
    Result<Part> part = load_part(file, stage);
    if (!part) return tl::unexpected(part.error());
    jaws.push_back({stage, *std::move(part)});
  }
  if (!jaws.empty()) return jaws;
  return fail(ErrorCode::kInsufficient,
              "{}: no jaw has a finished model; make one with flytri reconstruct --keep",
              file.path().string());
}

/// For this export. The stages stand in the order of io::kScanStages.
Result<void> set_plane(std::vector<Jaw>& jaws, const OcclusalPoints& points) {
  for (Jaw& jaw : jaws) {
    if (!reconstruct::jaw_of(jaw.stage)) continue;
    jaw.part.plane = points;
    return {};
  }
  return fail(ErrorCode::kInsufficient,
              "--occlusal-plane: neither the upper nor the lower jaw is finished");
}

Result<reconstruct::JawPlaces> places_of(const std::vector<Jaw>& jaws, const Progress& progress) {
  std::vector<reconstruct::FinishedJaw> finished;
  finished.reserve(jaws.size());
  for (const Jaw& jaw : jaws)
    finished.push_back({jaw.stage, jaw.part.name, &jaw.part.surface, jaw.part.plane});
  Result<reconstruct::JawPlaces> places = reconstruct::place_jaws(finished, Workers(), progress);
  if (places && !places->are_closed && jaws.size() > 1) {
    print_error(
        "flytri: warning: the jaws do not lie as they bite, each is in its own occlusal plane: "
        "finish the scans of the upper jaw, the lower jaw and the bite\n");
  }
  return places;
}

std::vector<fs::path> models_of(const JawsExport& wanted, const std::vector<Jaw>& jaws) {
  std::vector<io::ScanStage> stages;
  stages.reserve(jaws.size());
  for (const Jaw& jaw : jaws) stages.push_back(jaw.stage);
  std::vector<fs::path> models;
  for (const fs::path& output : wanted.outputs) {
    for (fs::path& model : reconstruct::jaw_models(output, stages))
      models.push_back(std::move(model));
  }
  return models;
}

/// The jaws in the density and the frame in which they are written.
Result<std::vector<reconstruct::PatientJaw>> patient_jaws(const std::vector<Jaw>& jaws,
                                                          const reconstruct::JawPlaces& places,
                                                          reconstruct::MeshDensity density,
                                                          const Progress& progress) {
  progress.begin_stage(reconstruct::kThinningTriangles, jaws.size());
  std::vector<reconstruct::PatientJaw> placed;
  for (const Jaw& jaw : jaws) {
    Result<reconstruct::ModelAtDensity> model =
        reconstruct::at_density(jaw.part.model, density, progress);
    if (!model) return tl::unexpected(model.error());
    print_density(*model);
    placed.push_back(reconstruct::in_patient(jaw.stage, *std::move(model), places));
  }
  return placed;
}

/// @param written  gets the files that are complete
Result<void> write_all_jaws(const JawsExport& wanted,
                            const std::vector<reconstruct::PatientJaw>& jaws,
                            std::vector<fs::path>& written) {
  for (const fs::path& output : wanted.outputs) {
    const std::size_t before = written.size();
    Result<void> done = reconstruct::write_jaws(output, jaws, written);
    for (std::size_t i = before; i < written.size(); ++i)
      print_out("wrote {}\n", written[i].string());
    if (!done) return done;
  }
  return {};
}

}  // namespace

Result<void> export_jaws(const JawsExport& wanted, CaseAccess& access, const Progress& progress) {
  Result<io::CaseFile> file = access.open(true);
  if (!file) return tl::unexpected(file.error());
  Result<std::vector<Jaw>> jaws = load_jaws(*file);
  if (!jaws) return tl::unexpected(jaws.error());
  if (auto checked = check_output_files(models_of(wanted, *jaws), {}, wanted.force); !checked)
    return checked;
  if (wanted.plane) {
    if (auto set = set_plane(*jaws, *wanted.plane); !set) return set;
  }
  const Result<reconstruct::JawPlaces> places = places_of(*jaws, progress);
  if (!places) return tl::unexpected(places.error());
  const auto placed = patient_jaws(*jaws, *places, wanted.density, progress);
  if (!placed) return tl::unexpected(placed.error());
  std::vector<fs::path> written;
  Result<void> done = write_all_jaws(wanted, *placed, written);
  if (!written.empty()) access.note(io::CaseAction::kExported, std::nullopt, written);
  return done;
}

}  // namespace flytri::cli
