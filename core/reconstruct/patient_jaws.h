/// @file  All finished stages of a case in one frame, and the files that hold them.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/base/workers.h"
#include "core/geometry/jaw_axes.h"
#include "core/io/cases/case_file.h"
#include "core/reconstruct/mesh_density.h"

namespace flytri::reconstruct {

/// A finished stage.
struct FinishedJaw {
  io::ScanStage stage = io::ScanStage::kUpper;
  std::string name;                                    ///< for messages
  const TriangleMesh* surface = nullptr;               ///< not null
  std::optional<OcclusalPoints> plane = std::nullopt;  ///< set by the user; none: found by itself
};

/// Where the stages of a case lie in the patient, see occlusion::T_patient_jaw.
struct JawPlaces {
  std::array<Isometry, io::kScanStages.size()> T_patient_world;  ///< by stage
  /// They lie as they bite. False: a stage is missing, and each lies in its own occlusal plane.
  bool are_closed = false;

  [[nodiscard]] Isometry& of(io::ScanStage stage) { return T_patient_world[index_of(stage)]; }
};

/// Closed jaws share one occlusal plane: one that the user has set, else one that was found. If
/// both jaws have one, that of the upper jaw. Pre-op and scan body are placed on their jaw.
/// @param jaws  at most one for each stage
/// @errors  As occlusion::find_occlusion and place_on_jaw; kInconsistent: the plane that the user
///          has set does not fit.
[[nodiscard]] Result<JawPlaces> place_jaws(std::span<const FinishedJaw> jaws,
                                           const Workers& workers, const Progress& progress);

/// A stage as it is written: in one density, and in the frame of the patient.
struct PatientJaw {
  io::ScanStage stage = io::ScanStage::kUpper;
  ModelAtDensity model;
};
[[nodiscard]] PatientJaw in_patient(io::ScanStage stage, ModelAtDensity model,
                                    const JawPlaces& places);

/// The models to write for `output`. NAME.glb holds all stages. NAME.stl becomes NAME-upper.stl,
/// NAME-lower.stl, NAME-bite.stl and so on, see to_string(ScanStage).
[[nodiscard]] std::vector<std::filesystem::path> jaw_models(const std::filesystem::path& output,
                                                            std::span<const io::ScanStage> stages);

/// Writes what jaw_models() names: a .glb has a node for each stage, named like it.
/// @param written  gets the models that are complete, also before a failure
/// @errors  As io::write_model and io::encode_glb_scene.
[[nodiscard]] Result<void> write_jaws(const std::filesystem::path& output,
                                      std::span<const PatientJaw> jaws,
                                      std::vector<std::filesystem::path>& written);

}  // namespace flytri::reconstruct
