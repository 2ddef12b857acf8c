/// @file  From finished scans to both jaws closed: how they meet, and how near they are everywhere.
#pragma once

#include "core/occlusion/clearance.h"
#include "core/occlusion/occlude.h"

namespace flytri::occlusion {

/// Clearances are found up to this distance, mm.
inline constexpr double kClearanceLimit_mm = 3.0;

struct ClosedJaws {
  Occlusion occlusion;
  Clearance upper, lower;                ///< of each jaw to the other one, by vertex
  Vec3 least_certain_mm = Vec3::Zero();  ///< place of the lower jaw, frame of the upper jaw
};

/// Arguments and errors as find_occlusion().
[[nodiscard]] Result<ClosedJaws> close_jaws(const TriangleMesh& upper, const TriangleMesh& lower,
                                            std::span<const BiteScan> bites,
                                            const OccludeOptions& options, const Workers& workers,
                                            const Progress& progress);

}  // namespace flytri::occlusion
