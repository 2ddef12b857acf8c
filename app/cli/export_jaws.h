/// @file  flytri export --jaws: all jaws of a case in one frame.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "app/cli/case_access.h"
#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/geometry/jaw_axes.h"
#include "core/reconstruct/mesh_density.h"

namespace flytri::cli {

struct JawsExport {
  std::vector<std::filesystem::path> outputs;  ///< as --output
  reconstruct::MeshDensity density = reconstruct::MeshDensity::kCad;
  bool force = false;  ///< files that exist are replaced
  /// Sets the occlusal plane of the upper jaw, or of the lower one if it is alone; none: as the
  /// case says.
  std::optional<OcclusalPoints> plane = std::nullopt;
};

/// Writes every finished stage of a case in the frame of the patient, see
/// occlusion::T_patient_jaw: NAME.glb has a node for each, NAME.stl becomes NAME-upper.stl,
/// NAME-lower.stl and NAME-bite.stl. The bite places the jaws as in flytri occlude. Without one
/// each jaw lies in its own occlusal plane, and a message says so.
/// @errors  As load_part, check_output_files, find_occlusion and write_model;
///          kInsufficient: no stage is finished.
[[nodiscard]] Result<void> export_jaws(const JawsExport& wanted, CaseAccess& access,
                                       const Progress& progress);

}  // namespace flytri::cli
