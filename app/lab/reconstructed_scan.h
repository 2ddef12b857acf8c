/// @file  A simulated scan that was reconstructed, laid on its true surface.
#pragma once

#include <optional>

#include "app/lab/simulated_scan.h"
#include "core/reconstruct/reconstruct.h"

namespace flytri::lab {

struct ReconstructedScan {
  TriangleMesh surface;                           ///< world frame
  std::vector<reconstruct::JudgedSpan> spans;     ///< world frame
  Isometry T_model_world = Isometry::Identity();  ///< by best fit on the true surface
};

/// @param model  the true surface
/// @param jaw    which it is, if it is one
/// @errors  As reconstruct::reconstruct_views.
[[nodiscard]] Result<ReconstructedScan> reconstruct_scan(const SimulatedScan& scan,
                                                         const TriangleMesh& model,
                                                         std::optional<JawKind> jaw,
                                                         const Workers& workers,
                                                         const Progress& progress);

/// Scans with the virtual intra-oral sensor along an arch, and reconstructs.
/// @param seed  of the path and the noise
[[nodiscard]] Result<ReconstructedScan> scan_arch(const TriangleMesh& jaw, JawKind kind,
                                                  int view_count, std::uint64_t seed,
                                                  const Workers& workers, const Progress& progress);

}  // namespace flytri::lab
